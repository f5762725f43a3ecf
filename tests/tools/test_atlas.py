"""The package as its users call it: what an atlas answers is what its files hold."""
import json
import shutil
import unittest

import h5py
import numpy as np
import xarray

from package_test import TINY, WithFolder

import rubatlas
from bands import in_bands
from rubatlas.query import GRAMMAR


class AtlasQuestions(WithFolder):
    def setUp(self):
        super().setUp()
        self.atlas = rubatlas.open(TINY / "atlas.h5", maps=TINY / "maps.h5")
        with h5py.File(TINY / "atlas.h5") as file, h5py.File(TINY / "maps.h5") as maps:
            self.speed, self.status = file["speed_ratio"][...], file["status"][0, 0, 0]
            self.displacement = np.where(self.status == 1, file["max_displacement"][0, 0, 0], np.nan)
            self.sections, self.motion = file["poincare"][0, 0, 0], maps["class"][0, 0, 0]
            self.margin = maps["margins/along_speed_ratio"][0, 0, 0]

    def test_rows_that_are_not_done_hold_no_numbers(self):
        self.assertTrue((self.status != 1).any())
        np.testing.assert_array_equal(self.atlas["max_displacement"], self.displacement)
        np.testing.assert_array_equal(np.isnan(self.atlas["poincare"]).any(axis=(2, 3)), self.status != 1)
        self.assertEqual(len(self.atlas), (self.status == 1).sum())

    def test_after_how_many_revolutions_points_had_settled_is_asked_like_any_quantity(self):
        with h5py.File(TINY / "atlas.h5") as file:
            settled = file["settled"][0, 0, 0]
        self.assertTrue((settled > 0).any() and (settled[self.status == 1] == 0).any())
        np.testing.assert_array_equal(self.atlas["settled"], np.where(self.status == 1, settled, np.nan))
        self.assertEqual(len(self.atlas.where("settled > 0")), (settled > 0).sum())

    def test_what_became_of_seams_is_asked_in_words(self):
        shutil.copy(TINY / "atlas.h5", self.folder / "cut.h5")
        with h5py.File(self.folder / "cut.h5", "r+") as file:
            seam = file.create_dataset("seam", data=np.zeros_like(file["status"][...]))
            seam[0, 0, 0, 0, np.flatnonzero(self.status.reshape(-1, self.speed.size)[0] == 1)[3]] = 3
            for axis, scale in zip(seam.dims, file["status"].dims):
                axis.attach_scale(scale[0])
            seam.attrs["flag_values"] = np.arange(4, dtype="u1")
            seam.attrs["flag_meanings"] = "none agrees repaired aperiodic_on_both_sides"
        cut = rubatlas.open(self.folder / "cut.h5")
        self.assertEqual((cut["seam"] == "aperiodic on both sides").sum(), 1)

    def test_maps_are_joined_and_units_are_those_of_the_file(self):
        np.testing.assert_array_equal(self.atlas["class"] == "unresolved", (self.motion == 254) & (self.status == 1))
        np.testing.assert_array_equal(self.atlas["margin"], np.where(self.status == 1, self.margin, np.nan))
        self.assertEqual((self.atlas["max_displacement"].units, self.atlas["speed_ratio"].units), ("m", "-"))
        self.assertEqual(self.atlas.dataset["max_displacement"].dims, ("damping_ratio", "speed_ratio"))

    def test_maps_beside_the_atlas_are_found_and_those_of_another_are_refused(self):
        shutil.copy(TINY / "atlas.h5", self.folder / "a.h5")
        self.assertNotIn("class", rubatlas.open(self.folder / "a.h5"))
        shutil.copy(TINY / "maps.h5", self.folder / "a_maps.h5")
        self.assertIn("class", rubatlas.open(self.folder / "a.h5"))
        with self.assertRaisesRegex(rubatlas.AtlasError, "was not made from the scene"):
            rubatlas.open(TINY / "atlas.h5", maps=TINY / "rings_maps.h5")

    def test_maps_that_were_made_before_further_points_were_finished_are_refused(self):
        shutil.copy(TINY / "atlas.h5", self.folder / "a.h5")
        shutil.copy(TINY / "maps.h5", self.folder / "a_maps.h5")
        with h5py.File(self.folder / "a_maps.h5", "r+") as file:
            file.attrs["points_finished"] -= 1
        with self.assertRaisesRegex(rubatlas.AtlasError, r"a.h5 has \d+ points finished, and \S+a_maps.h5 was made of "
                                                         r"\d+: `rubatlas analyse \S+ -o \S+ --overwrite` makes it"):
            rubatlas.open(self.folder / "a.h5")

    def test_a_selection_has_the_numbers_of_its_points(self):
        chosen = self.atlas.sel(damping_ratio=0.2, speed_ratio=slice(0.3, 0.5))
        inside = (self.speed >= 0.3) & (self.speed <= 0.5)
        self.assertTrue(0 < inside.sum() < len(self.speed))
        np.testing.assert_array_equal(chosen["max_displacement"], self.displacement[2, inside])
        np.testing.assert_array_equal(chosen["poincare"].sel(component="x"), self.sections[2, inside, :, 0])
        np.testing.assert_array_equal(self.atlas.sel(damping_ratio=[0.05, 0.2])["max_displacement"],
                                      self.displacement[[0, 2]])
        with self.assertRaisesRegex(rubatlas.AtlasError, "damping_ratio 0.7 is not in this atlas"):
            self.atlas.sel(damping_ratio=0.7)
        with self.assertRaisesRegex(rubatlas.AtlasError, "dampng: no axis"):
            self.atlas.sel(dampng=0.7)

    def test_a_value_without_a_name_is_a_speed_ratio_that_the_grid_has_or_the_nearest_one(self):
        place = 20
        speed = self.speed[place]
        np.testing.assert_array_equal(self.atlas.sel(speed)["max_displacement"],
                                      self.atlas.sel(speed_ratio=speed)["max_displacement"])
        between = speed + 0.3 * (self.speed[1] - self.speed[0])
        for ask in (self.atlas.sel, self.atlas.line(damping_ratio=0.1).plot.spectrum):
            with self.assertRaisesRegex(rubatlas.AtlasError,
                                        "speed_ratio .* is not in this atlas, which has nearby .*; method=.nearest. "):
                ask(between)
            with self.assertRaisesRegex(rubatlas.AtlasError, "speed_ratio 1.2 is outside this atlas, which has 0.2 to"):
                ask(1.2, method="nearest")
            with self.assertRaisesRegex(rubatlas.AtlasError, "method 'next': None, or \"nearest\""):
                ask(speed, method="next")
        self.assertEqual(self.atlas.sel(between, method="nearest")["speed_ratio"], speed)
        self.assertEqual(self.atlas.sel(damping_ratio=0.12, method="nearest")["damping_ratio"], 0.1)
        drawn, expected = (self.atlas.plot.spectrum(*ask, damping_ratio=0.1, **how).collections[0].get_segments()
                           for ask, how in (((between,), {"method": "nearest"}), ((speed,), {})))
        np.testing.assert_array_equal(drawn, expected)
        with self.assertRaisesRegex(rubatlas.AtlasError, "one value may stand without a name, the speed ratio"):
            self.atlas.sel(speed, 0.1)
        with self.assertRaisesRegex(rubatlas.AtlasError, "one value may stand without a name, the speed ratio"):
            self.atlas.sel(speed, speed_ratio=speed)

    def test_an_orbit_is_that_of_the_speed_that_is_asked_for_or_of_the_nearest_of_the_grid(self):
        speed, line = self.speed[5], self.atlas.line(damping_ratio=0.2)
        between = speed + 0.3 * (self.speed[1] - self.speed[0])
        exact, near = line.orbit(between), line.orbit(between, method="nearest")
        self.assertEqual((exact.attributes["speed_ratio"], near.attributes["speed_ratio"]), (between, speed))
        with h5py.File(TINY / "atlas.h5") as file:
            np.testing.assert_array_equal(near.attributes["start"], file["final_state"][0, 0, 0, 2, 5])
        other = self.atlas.orbit(between, method="nearest", damping_ratio=0.19)
        self.assertEqual((other.attributes["speed_ratio"], other.attributes["damping_ratio"]), (speed, 0.2))

    def test_points_are_chosen_by_their_places(self):
        np.testing.assert_array_equal(self.atlas.isel(3)["max_displacement"],
                                      self.atlas.sel(self.speed[3])["max_displacement"])
        self.assertEqual(self.atlas.isel(-1, damping_ratio=0)["speed_ratio"], self.speed[-1])
        np.testing.assert_array_equal(self.atlas.isel(slice(2, 6), damping_ratio=1)["max_displacement"],
                                      self.displacement[1, 2:6])
        np.testing.assert_array_equal(self.atlas.isel(damping_ratio=[2, 0], friction=0)["poincare"][..., 0],
                                      np.where(self.status[[2, 0], :, None] == 1, self.sections[[2, 0], ..., 0],
                                               np.nan))
        slow = self.speed < 0.35
        np.testing.assert_array_equal(self.atlas.isel(slow)["speed_ratio"], self.speed[slow])
        for axis, place in (("speed_ratio", 36), ("damping_ratio", [0, 3]), ("speed_ratio", slow[:5]), ("friction", 1),
                            ("damping_ratio", 0.1)):
            with self.assertRaisesRegex(rubatlas.AtlasError, f"{axis}: .* is no place on an axis of"):
                self.atlas.isel(**{axis: place})
        with self.assertRaisesRegex(rubatlas.AtlasError, "dampng: no axis"):
            self.atlas.isel(dampng=0)

    def test_a_mask_leaves_the_points_at_which_it_is_true(self):
        wanted = self.displacement > 5e-3
        self.assertTrue(0 < wanted.sum() < wanted.size)
        part = self.atlas.sel(damping_ratio=[0.05, 0.2])
        turned = self.atlas["max_displacement"].transpose() > 5e-3
        for kept, expected in ((self.atlas[self.atlas["max_displacement"] > 5e-3], wanted),
                               (self.atlas.where(wanted), wanted), (self.atlas.where(turned), wanted),
                               (part[turned], wanted[[0, 2]]),
                               (self.atlas[self.atlas["speed_ratio"] < 0.35], (self.status == 1) & (self.speed < 0.35)),
                               (self.atlas[part["max_displacement"] > 5e-3], wanted & [[True], [False], [True]])):
            np.testing.assert_array_equal(np.isfinite(kept["max_displacement"]), expected)
            self.assertEqual(len(kept), expected.sum())
        for mask, words in ((wanted[0], r"a mask of the shape \(36,\); .* has damping_ratio 3 × speed_ratio 36"),
                            (self.displacement, "a mask is of true and false, not of float64"),
                            (self.atlas["poincare"] > 0, "a mask along damping_ratio, speed_ratio, section, comp")):
            with self.assertRaisesRegex(rubatlas.AtlasError, words):
                self.atlas.where(mask)

    def test_a_notebook_shows_the_points_and_the_table_of_quantities(self):
        shown = self.atlas._repr_html_()
        self.assertIn(f"{len(self.atlas)} points of damping_ratio 3, speed_ratio 36", shown)
        self.assertIn("max_displacement", shown)
        self.assertNotIn("<Atlas", shown)  # which a browser would take for markup

    def test_a_line_has_the_scenes_own_values(self):
        np.testing.assert_array_equal(self.atlas.line()["max_displacement"], self.displacement[1])
        np.testing.assert_array_equal(self.atlas.line(damping_ratio=0.05)["max_displacement"], self.displacement[0])

    def test_a_condition_leaves_the_points_at_which_it_holds(self):
        kept = self.atlas.where("class == 'unresolved' and max_displacement > 5e-3")
        wanted = (self.status == 1) & (self.motion == 254) & (self.displacement > 5e-3)
        self.assertTrue(0 < wanted.sum() < wanted.size)
        np.testing.assert_array_equal(np.isfinite(kept["max_displacement"]), wanted)
        found = list(kept.points())
        self.assertEqual(len(found), wanted.sum())
        self.assertTrue(all(point["class"] == "unresolved" and point["max_displacement"] > 5e-3 for point in found))
        self.assertEqual(len(kept.where("speed_ratio < 0")), 0)
        with self.assertRaisesRegex(rubatlas.AtlasError, "the nearest name is max_displacement"):
            self.atlas.where("max_displacment > 1")

    def test_a_condition_has_units_and_those_of_the_rotor_are_those_of_each_line(self):
        rings = rubatlas.open(TINY / "rings.h5")
        with h5py.File(TINY / "rings.h5") as file:
            displacement = np.where(file["status"][...] == 1, file["max_displacement"][...], np.nan)
            radius, speed = file["ring_radius"][...], file["speed_ratio"][...]
            frequency = json.loads(file["scene_resolved"][()])["rotor"]["natural_frequency"]
        clearance = (radius - 0.1).reshape(-1, *[1] * (displacement.ndim - 1))
        for text, wanted in (("max displacement > 4 mm", displacement > 4e-3),
                             ("max_displacement > 0.4 clearances", displacement > 0.4 * clearance),
                             ("speed < 43 rpm", speed < 43 * np.pi / 30 / frequency),
                             ("ring radius = 109 mm", radius.reshape(clearance.shape) == 0.109)):
            wanted = np.broadcast_to(wanted, displacement.shape) & np.isfinite(displacement)
            self.assertTrue(0 < wanted.sum() < wanted.size, text)
            found = np.isfinite(rings.where(text)["max_displacement"].values)
            np.testing.assert_array_equal(found, wanted.reshape(found.shape), text)
        with self.assertRaisesRegex(rubatlas.AtlasError, "a length, what stands after it is a force"):
            rings.where("max_displacement < 3 N")

    def test_a_condition_knows_the_largest_exponent_and_says_what_has_rows(self):
        rows = GRAMMAR["names_of_rows"]
        scene = {"grid": {"speed_ratio": [0.5, 0.52, 0.7], "damping_ratio": [0.05, 0.1]}, "observables":
                 ["max_displacement", "lyapunov", *(name for name in rows
                                                    if name not in ("final_state", "lyapunov_error"))],
                 "protocol": {"transient_revolutions": 10, "sampled_revolutions": 20, "samples_per_revolution": 16}}
        atlas = rubatlas.run(scene, self.folder / "exponents.h5")
        with h5py.File(atlas.path) as file:
            largest = np.where(file["status"][...] == 1, file["lyapunov"][..., 0], np.nan).squeeze()
            found = [name for name, dataset in file.items() if name != "lyapunov" and getattr(dataset, "ndim", 0) > 5]
        self.assertEqual(sorted(found), sorted(rows))
        middle = float(np.nanmedian(largest))
        self.assertTrue(0 < (largest > middle).sum() < largest.size)
        part = atlas.sel(damping_ratio=0.1, speed_ratio=[0.7, 0.5])
        for part, wanted in ((atlas, largest), (part, largest[1, [2, 0]])):
            kept = part.where(f"lyapunov > {middle!r}")
            np.testing.assert_array_equal(np.isfinite(kept["max_displacement"]), wanted > middle)
        for name in rows:
            with self.assertRaisesRegex(rubatlas.AtlasError, f"{name} > 0: {name} has rows of its own, and no single "):
                atlas.where(f"{name} > 0")
        with self.assertRaisesRegex(rubatlas.AtlasError, "lyapunov is not in this atlas"):
            self.atlas.where("lyapunov > 0")

    def test_bands_are_the_runs_of_neighbouring_points_of_one_line(self):
        bands = self.atlas.line(damping_ratio=0.05).where("class == 'unresolved'").bands()
        inside = np.zeros(len(self.speed), dtype=bool)
        for low, high in bands:
            inside |= (self.speed >= low) & (self.speed <= high)
        np.testing.assert_array_equal(inside, (self.motion[0] == 254) & (self.status[0] == 1))
        self.assertTrue(inside.any() and all(one[1] < other[0] for one, other in zip(bands, bands[1:])))
        with self.assertRaisesRegex(rubatlas.AtlasError, "damping_ratio still has several values"):
            self.atlas.bands()

    def test_bands_do_not_join_speeds_that_are_not_neighbours(self):
        line = self.atlas.line(damping_ratio=0.2)
        chosen = self.speed[[4, 3, 9]]
        self.assertEqual(line.sel(speed_ratio=list(chosen)).bands(),
                         [(self.speed[3], self.speed[4]), (self.speed[9], self.speed[9])])
        self.assertEqual(line.sel(speed_ratio=self.speed[5]).bands(), [(self.speed[5], self.speed[5])])

    def test_values_that_are_not_there_or_no_values_are_refused_in_words(self):
        for wanted in (float("nan"), "much", None, slice("a", None)):
            with self.assertRaisesRegex(rubatlas.AtlasError, "damping_ratio"):
                self.atlas.sel(damping_ratio=wanted)
            with self.assertRaisesRegex(rubatlas.AtlasError, "friction"):
                self.atlas.sel(friction=wanted)
        with self.assertRaisesRegex(rubatlas.AtlasError, "damping_ratio nan is not in this atlas"):
            self.atlas.line(damping_ratio=float("nan"))
        for draw, words in ((lambda plot: plot.bifurcation(component="z"), "x or y"),
                            (lambda plot: plot.blade(what="length"), "shortening and deflection"),
                            (lambda plot: plot.map(quantity="status"), "words, not numbers")):
            with self.assertRaisesRegex(rubatlas.AtlasError, words):
                draw(self.atlas.plot)
        with self.assertRaisesRegex(rubatlas.AtlasError, "these are the maps of an atlas"):
            rubatlas.open(TINY / "maps.h5")

    def test_a_value_that_the_selection_has_alone_may_be_named_again(self):
        self.assertEqual(len(self.atlas.sel(friction=0.1)), len(self.atlas))
        with self.assertRaisesRegex(rubatlas.AtlasError, "this selection has 0.1 alone"):
            self.atlas.sel(friction=0.2)
        chosen = self.atlas.sel(damping_ratio=0.2)
        self.assertEqual(len(chosen.line(damping_ratio=0.2)), len(chosen))
        with self.assertRaisesRegex(rubatlas.AtlasError, "this selection has 0.2 alone"):
            chosen.line(damping_ratio=0.1)

    def test_rows_of_any_selection_are_read(self):
        self.assertEqual(self.atlas.sel(speed_ratio=slice(2, 3))["poincare"].sizes["speed_ratio"], 0)
        turned = self.atlas.sel(damping_ratio=[0.2, 0.1])["poincare"].values
        np.testing.assert_array_equal(turned[0], self.atlas.sel(damping_ratio=0.2)["poincare"].values)
        self.atlas.sel(speed_ratio=self.speed[5]).plot.bifurcation()
        self.assertIn("damping", self.atlas.plot.margin(name="damping_ratio").get_title(loc="left"))

    def test_a_motion_without_a_class_and_one_that_leaves_the_model_are_not_safe(self):
        line = self.atlas.line(damping_ratio=0.05)
        bands = line.safe_speeds("class<=255")["bands"]
        inside = np.any([(self.speed >= band["from"]) & (self.speed <= band["to"]) for band in bands], axis=0)
        np.testing.assert_array_equal(inside, in_bands(self.motion[0] > 0))
        ends = [end for band in bands for end in (band["below"], band["above"]) if "speed_ratio" in end]
        self.assertTrue(any("the motion leaves the model" in end["broken"] for end in ends))
        for end in ends:
            self.assertEqual(end["open"], self.status[0, np.argmin(abs(self.speed - end["speed_ratio"]))] not in (1, 2))

    def test_safe_speeds_keep_the_limits_on_every_line_of_the_selection(self):
        for atlas, lines in ((self.atlas, slice(None)), (self.atlas.sel(damping_ratio=0.2), slice(2, 3))):
            safe = ((self.displacement <= 8e-3) & ~(self.margin < 0.008) & (self.status == 1))[lines].all(axis=0)
            inside = np.zeros(len(self.speed), dtype=bool)
            for band in atlas.safe_speeds(max_displacement=8e-3, margin=0.008)["bands"]:
                inside |= (self.speed >= band["from"]) & (self.speed <= band["to"])
            self.assertTrue(in_bands(safe).any())
            np.testing.assert_array_equal(inside, in_bands(safe))
        some = self.atlas.sel(damping_ratio=[0.1, 0.2],
                              speed_ratio=slice(0.4, None)).where("class == 'period 1' or class == 'period 2'")
        chosen = (((self.status == 1) & (self.motion >= 1) & (self.motion <= 2))[1:]).all(axis=0) & (self.speed >= 0.4)
        kept = some.safe_speeds(max_displacement=1.0)["bands"]
        np.testing.assert_array_equal(np.any([(self.speed >= band["from"]) & (self.speed <= band["to"])
                                              for band in kept], axis=0), in_bands(chosen))
        self.assertEqual(kept[0]["below"]["broken"], ["not selected"])
        operate = self.atlas.line().safe_speeds(max_displacement="8 mm", operate="24 rpm")["operate"]
        self.assertRegex(operate["text"], r"^At Ω 0\.251327 \(24 rpm, 0\.4 Hz\) every limit is kept in the sweep up;")
        with self.assertRaisesRegex(rubatlas.AtlasError, "no limit is given"):
            self.atlas.safe_speeds()

    def test_every_line_says_where_blades_touch(self):
        with h5py.File(TINY / "atlas.h5") as file:
            touching = file["contact_fraction"][0, 0, 0] > 0.0
        np.testing.assert_array_equal(self.atlas["contact"] == "contact", touching & (self.status == 1))
        self.assertEqual(self.atlas.contacts.dims, ("damping_ratio",))
        left = (self.status != 1).sum(axis=1)
        self.assertEqual(list(self.atlas.contacts.values), ["contact at every speed" + (
            f"; {speeds} speeds are not done" if speeds else "") for speeds in left])
        self.assertEqual(self.atlas.line(damping_ratio=0.1).contacts.item(), "contact at every speed")

    def test_xarray_opens_every_group_of_the_maps(self):
        opened = set()
        for path in sorted(TINY.glob("*maps.h5")):
            with h5py.File(path) as file:
                groups = [name for name in file if isinstance(file[name], h5py.Group)]
                axes = {name for name in file if name not in groups and h5py.h5ds.is_scale(file[name].id)}
            for group in groups:
                with self.subTest(path=path.name, group=group), \
                        xarray.open_dataset(path, engine="h5netcdf", group=group) as dataset:
                    # What has the name of an axis would be laid over by that axis in a tree of all groups.
                    self.assertFalse(set(dataset.variables) & axes)
                    self.assertGreater(len(dataset.data_vars), 0)
                    opened.add(group)
            if hasattr(xarray, "open_datatree"):
                with xarray.open_datatree(path, engine="h5netcdf") as tree:
                    self.assertEqual({str(name) for name in tree.children}, set(groups))
        self.assertLessEqual({"table1", "margins", "doublings", "basins"}, opened)

    def test_maps_of_an_older_layout_are_refused_in_one_sentence(self):
        shutil.copy(TINY / "maps.h5", self.folder / "maps.h5")
        with h5py.File(self.folder / "maps.h5", "r+") as file:
            file.attrs["schema_version"] = "3"
        with self.assertRaisesRegex(rubatlas.AtlasError, "another version than 6; `rubatlas analyse"):
            rubatlas.open(TINY / "atlas.h5", maps=self.folder / "maps.h5")

    def test_edges_lie_beside_the_atlas_or_are_not_there(self):
        self.assertIsNone(self.atlas.edges)
        shutil.copy(TINY / "atlas.h5", self.folder / "a.h5")
        with h5py.File(self.folder / "a_edges.h5", "w") as file:
            file["edges/lower"], file["edges/upper"] = [0.3, 0.5], [0.31, 0.51]
        np.testing.assert_array_equal(rubatlas.open(self.folder / "a.h5").edges["upper"], [0.31, 0.51])
        with h5py.File(self.folder / "a_edges.h5", "r+") as file:
            file["edges"].attrs["points_finished"] = 1
        with self.assertRaisesRegex(rubatlas.AtlasError, r"a_edges.h5 was made of 1: `rubatlas edges \S+a.h5 -o "):
            _ = rubatlas.open(self.folder / "a.h5").edges

    def test_an_orbit_starts_from_the_state_that_the_atlas_keeps(self):
        orbit = self.atlas.orbit(0.3, damping_ratio=0.2)
        place = int(np.argmin(abs(self.speed - 0.3)))
        with h5py.File(TINY / "atlas.h5") as file:
            start = file["final_state"][0, 0, 0, 2, place]
        np.testing.assert_array_equal(orbit.attributes["start"], start)
        self.assertEqual(orbit.attributes["damping_ratio"], 0.2)

    def test_an_orbit_that_is_stored_is_read_and_one_of_another_point_is_kept(self):
        path = self.folder / "orbit.h5"
        self.atlas.orbit(0.3, path=path)
        content = path.read_bytes()
        again = self.atlas.sel(damping_ratio=0.1).orbit(0.3, path=path, )
        self.assertEqual((again.attributes["damping_ratio"], path.read_bytes()), (0.1, content))
        with self.assertRaisesRegex(rubatlas.AtlasError, "an orbit at another damping ratio, 0.1; choose another path"):
            self.atlas.orbit(0.3, path=path, damping_ratio=0.2)
        self.assertEqual(path.read_bytes(), content)
        with h5py.File(path, "r+") as file:
            file.attrs["start"] = file.attrs["start"] * 1.5
        with self.assertRaisesRegex(rubatlas.AtlasError, "an orbit from another state at these values"):
            self.atlas.orbit(0.3, path=path)
        with h5py.File(path, "r+") as file:
            scene = json.loads(file["scene_resolved"][()])
            scene["rotor"]["misalignment"] = 0.02
            file["scene_resolved"][()] = json.dumps(scene)
        with self.assertRaisesRegex(rubatlas.AtlasError, "/rotor/misalignment is 0.01001 here and 0.02 there"):
            self.atlas.orbit(0.3, path=path)

    def test_a_file_that_is_no_atlas_is_said_to_be_none(self):
        with self.assertRaisesRegex(rubatlas.AtlasError, "no such file"):
            rubatlas.open("nowhere.h5")
        with self.assertRaisesRegex(rubatlas.AtlasError, "not a readable HDF5 file"):
            rubatlas.open(__file__)


if __name__ == "__main__":
    unittest.main()

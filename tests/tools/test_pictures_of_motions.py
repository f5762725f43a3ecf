"""Pictures of single motions, spectrum and orbit, and of the basins of all that there are."""
import importlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tests/support")]
from pictures import TINY, Figure, PicturesCase, run  # noqa: E402
from rubatlas import style  # noqa: E402
from rubatlas.atlas_file import AtlasFile, UnreadableFile  # noqa: E402
from rubatlas.palette import PALETTE  # noqa: E402
from rubatlas.plots.branch import BranchFile  # noqa: E402
from rubatlas.plots.orbit import OrbitFile  # noqa: E402


class PicturesOfMotions(PicturesCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        subprocess.run([os.environ["RUBATLAS_PROGRAM"], "orbit", ROOT / "tests/tools/tiny.json", "--at",
                        "speed_ratio=0.4,damping_ratio=0.1", "-o", cls.folder / "other.h5"], check=True,
                       capture_output=True)

    def test_the_spectrum_of_a_point_is_drawn(self):
        self.expect_picture("spectrum", TINY / "atlas.h5", "--speed_ratio", 0.6)

    def test_the_orbit_is_drawn(self):
        self.expect_picture("orbit", TINY / "orbit.h5")

    def test_forces_of_an_orbit_are_drawn_up_to_their_peaks(self):
        forces = Figure("orbit", TINY / "orbit.h5", "--revolutions", 16).figure.axes[1]
        with h5py.File(TINY / "orbit.h5") as orbit:
            blade, force = orbit["contact_blade"][:], orbit["contact_force"][:]
            sampled = orbit["force"][:].max(axis=0)
        self.assertEqual(len(forces.lines), 3)
        for number, curve in enumerate(forces.lines):
            drawn = curve.get_ydata()
            self.assertEqual(np.nanmax(drawn), force[blade == number + 1].max())
            self.assertGreaterEqual(np.nanmax(drawn), sampled[number])
            gaps = np.flatnonzero(np.isnan(drawn))  # each contact rises from zero and returns to it
            np.testing.assert_array_equal(drawn[gaps - 1], 0.0)
            np.testing.assert_array_equal(drawn[np.concatenate([[0], gaps[:-1] + 1])], 0.0)
        self.assertGreater(max(np.diff(line.get_ydata()[~np.isnan(line.get_ydata())]).size for line in forces.lines),
                           50)

    def test_the_peaks_of_an_orbit_are_those_of_all_its_revolutions(self):
        shutil.copy(TINY / "orbit.h5", self.folder / "uneven.h5")
        with h5py.File(self.folder / "uneven.h5", "r+") as orbit:
            blade, first = orbit["contact_blade"][:], orbit["contact_number"][:] < 3
            force = orbit["contact_force"][:]
            force[first] *= 10.0  # long before the last revolution
            force[(blade == 3) & ~first] = 0.0
            orbit["contact_force"][:] = force
        forces = Figure("orbit", self.folder / "uneven.h5", "--revolutions", 1).figure.axes[1]
        self.assertEqual([line.get_label() for line in forces.lines],
                         [f"blade {number}, up to {force[blade == number].max():.4g} N" for number in (1, 2, 3)])
        self.assertEqual(forces.get_xlabel(), "Time [revolutions]; the last 1 of 16, peaks of all")
        whole = Figure("orbit", self.folder / "uneven.h5", "--revolutions", 16).figure.axes[1]
        self.assertEqual(whole.get_xlabel(), "Time [revolutions]")

    def test_revolutions_at_a_speed_that_ramps_are_as_long_as_each_is(self):
        orbit = object.__new__(OrbitFile)
        orbit.attributes, orbit.scene = {"speed_ratio": 0.5}, {"speed_ramp": {"rate": 0.1}}
        orbit.data = {"sections": np.zeros((3, 4))}
        periods = 2.0 * np.pi / np.array([0.5, 0.6, 0.7])
        np.testing.assert_allclose(orbit.revolutions(np.cumsum(periods)), [1.0, 2.0, 3.0], rtol=1e-14)
        self.assertAlmostEqual(orbit.revolutions(periods[0] + 0.25 * periods[1]), 1.25)
        orbit.attributes["damping_ratio"], orbit.further_axes = 0.1, []
        self.assertEqual(orbit.describe(), "speed ratio 0.5 to 0.7, damping ratio 0.1")
        orbit.scene = {}
        self.assertEqual(orbit.describe(), "speed ratio 0.5, damping ratio 0.1")

    def test_an_orbit_is_drawn_in_its_own_ring(self):
        self.assertIn("clearance 9.5 mm", Figure("orbit", TINY / "rings_orbit.h5").texts())
        self.assertIn("ring radius 0.1095", Figure("orbit", TINY / "rings_orbit.h5").texts())

    def test_a_branch_has_the_unit_of_the_quantity_that_varies(self):
        path = self.folder / "branch.h5"
        command = [os.environ["RUBATLAS_PROGRAM"], "branch", ROOT / "tests/tools/rings.json", "-o", path, "--overwrite",
                   "--from", "speed_ratio=0.6,ring_radius=0.11,damping_ratio=0.2", "--points", "3"]
        for along, to, label in (("/ring/radius", "0.1", "Radius [m]"), ("speed_ratio", "0.7", "Speed ratio Ω [-]")):
            subprocess.run([*command, "--along", along, "--to", to], check=True, capture_output=True)
            self.assertEqual(Figure("branch", path).figure.axes[1].get_xlabel(), label)

    def test_a_doubled_branch_of_four_blades_is_told_by_its_blade_passings(self):
        scene, path = self.folder / "four.json", self.folder / "four.h5"
        scene.write_text(json.dumps({"title": "Four blades", "reference": "none", "blades": {"count": 4},
                                     "grid": {"speed_ratio": 0.512}}))
        subprocess.run([os.environ["RUBATLAS_PROGRAM"], "branch", scene, "-o", path, "--from", "speed_ratio=0.512",
                        "--along", "speed_ratio", "--to", "0.519", "--switch", "--points", "40"], check=True,
                       capture_output=True)
        with h5py.File(path) as file:
            self.assertEqual(set(file["period"][:]), {1})
            self.assertEqual([set(file["passings"][:][file["branch"][:] == which]) for which in (0, 1)], [{1}, {2}])
            doubling = file["events/kind"][:] == 2
            self.assertEqual(set(file["events/passings"][:][doubling]), {1})
            ends_at = file["events/parameter"][:][doubling][0]
        stable = Figure("branch", path).figure.axes[1].lines[0].get_xydata()
        np.testing.assert_allclose(stable[-1], [ends_at, 1.0], rtol=1e-6, err_msg="its largest multiplier is 1 there")

        def entries():
            legend = Figure("branch", path).figure.axes[0].get_legend()
            return [entry.get_text() for entry in legend.get_texts()][:2]
        self.assertEqual(entries(), ["branch of period 1, 1 blade passing", "branch of period 1, 2 blade passings"])
        with h5py.File(path, "r+") as file:
            file["passings"][0] = 0
        with self.assertRaisesRegex(UnreadableFile, "/passings are no numbers of blade passings, one of each orbit"):
            BranchFile(path)
        with h5py.File(path, "r+") as file:
            del file["passings"], file["events/passings"]  # as older versions wrote it
        self.assertEqual(entries(), ["branch of period 1"] * 2)

    def test_a_neimark_sacker_bifurcation_is_seen_around_a_grazing_at_the_same_place(self):
        path = self.folder / "crowded.h5"
        subprocess.run([os.environ["RUBATLAS_PROGRAM"], "branch", ROOT / "jobs/default.json", "-o", path, "--from",
                        "speed_ratio=0.62", "--along", "speed_ratio", "--to", "0.595"], check=True, capture_output=True)
        marks = {line.get_label(): line for line in Figure("branch", path).figure.axes[0].lines}
        bifurcation, grazing = marks["Neimark-Sacker"], marks["grazing"]
        self.assertLess(abs(bifurcation.get_xdata()[0] - grazing.get_xdata()[0]), 1e-3)
        self.assertEqual(bifurcation.get_markerfacecolor(), "none")
        self.assertGreater(bifurcation.get_markersize(), 1.5 * grazing.get_markersize())

    def test_several_orbits_have_a_panel_each_with_sections_clearance_and_middle_of_the_ring(self):
        figure = Figure("orbit", TINY / "orbit.h5", self.folder / "other.h5").figure
        *planes, bottom = figure.axes
        self.assertEqual(len(planes), 2)
        for plane, path, speed in zip(planes, (TINY / "orbit.h5", self.folder / "other.h5"), (0.3, 0.4)):
            with h5py.File(path) as orbit:
                state, sections = orbit["state"][:], orbit["sections"][:]
            self.assertTrue(plane.get_title(loc="left").endswith(f"speed ratio {speed}"))
            path_of, dots, circle, middle = plane.lines
            np.testing.assert_array_equal(path_of.get_xydata(), 1e3 * state[:, :2])
            np.testing.assert_array_equal(dots.get_xydata(), 1e3 * sections[:, :2])
            np.testing.assert_allclose(middle.get_xydata(), [[0.0, -10.01]])  # mm, the misalignment
            np.testing.assert_allclose(np.hypot(*(circle.get_xydata() - middle.get_xydata()).T), 10.0)  # mm
        self.assertIn("damping ratio 0.1", planes[0].get_title(loc="left"))
        self.assertEqual([text.get_text() for text in bottom.get_legend().get_texts()],
                         ["orbit", "section, once per revolution", "clearance 10 mm", "middle of the ring"])

    def test_orbits_of_different_rotors_are_not_drawn_together(self):
        ended = run("orbit", TINY / "orbit.h5", TINY / "rings_orbit.h5", "-o", "none.png")
        self.assertEqual(ended.returncode, 2)
        self.assertRegex(ended.stderr, r"^rubatlas-plot orbit: .*rings_orbit.h5 was not made from the scene of "
                                       r".*orbit.h5: /ring/radius is 0.11 here and 0.1095 there\n$")

    def test_basins_of_attraction_are_drawn(self):
        self.expect_picture("basins", TINY / "basins.h5", "--maps", TINY / "basins_maps.h5", "--dpi", 100, colours=10)

    def test_a_pixel_of_a_basin_has_the_colour_of_its_attractor(self):
        figure = Figure("basins", TINY / "basins.h5", "--maps", TINY / "basins_maps.h5")
        self.assertIn("Initial x [mm]", figure.texts())
        self.assertIn("Initial vx [mm]", figure.texts())
        with AtlasFile(TINY / "basins_maps.h5") as maps:
            motion, attractor = (maps.dataset(name)[:, :, 0, 0, 0, 0, :] for name in ("class", "attractor"))
        self.assertEqual(motion.shape, (5, 7, 2))  # initial_vx, initial_x, speed_ratio
        self.assertEqual(set(attractor[:, :, 0].ravel()), {1})
        self.assertLessEqual({1, 11}, set(motion[:, :, 1].ravel()))
        colour = {kind: style.matplotlib.colors.to_rgba(entry["colour"]) for entry in PALETTE["classes"]
                  for kind in range(entry["first"], entry["last"] + 1)}
        for speed, panel in enumerate(figure.figure.axes):
            wanted = [[colour[kind] for kind in row] for row in motion[:, :, speed]]
            np.testing.assert_array_equal(panel.images[0].get_array(), wanted)
            left, right, bottom, top = panel.images[0].get_extent()
            np.testing.assert_allclose([left, right, bottom, top], [-0.5, 6.5, 3.25, 10.75])  # mm, half a step around

    def test_panels_of_basins_have_their_speed_above_them(self):
        for chosen, names in (([], ["Ω = 0.3", "Ω = 0.438"]), (["--at", "speed_ratio=0.438"], ["Ω = 0.438"])):
            panels = Figure("basins", TINY / "basins.h5", "--maps", TINY / "basins_maps.h5", *chosen).figure.axes
            for panel, name in zip(panels, names, strict=True):
                self.assertTrue(panel.get_title(loc="left").endswith(name))
                self.assertEqual(panel.get_legend().get_title().get_text(), "")

    def test_attractors_of_one_colour_have_hatchings_of_their_own(self):
        basins = importlib.import_module("rubatlas.plots.basins")
        attractor, motion = np.array([[1, 2], [3, 4]]), np.array([[7, 7], [1, 9]])
        found = [entry for entry, where in basins.cells_of(attractor, motion, np.ones((2, 2))) if where.any()]
        self.assertEqual([entry["name"] for entry in found],
                         ["1: period 7, 25.0 %", "2: period 7, 25.0 %", "3: period 1, 25.0 %", "4: period 9, 25.0 %"])
        self.assertEqual(len({entry["colour"] for entry in found}), 2)
        self.assertEqual(len({(entry["colour"], entry["hatch"]) for entry in found}), 4)

    def test_basins_need_an_axis_of_the_initial_state(self):
        ended = run("basins", TINY / "atlas.h5", "--maps", TINY / "maps.h5", "-o", "none.png")
        self.assertEqual(ended.returncode, 2)
        self.assertRegex(ended.stderr,
                         r"^rubatlas-plot basins: .*: no axis of the initial state is left to draw over; "
                         r"the atlas has .*\n$")

    def test_of_many_initial_states_the_basins_are_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            ended = run("all", TINY / "basins.h5", "-o", folder)
            self.assertEqual((ended.returncode, ended.stderr), (0, ""))
            self.assertEqual([path.name for path in pathlib.Path(folder).iterdir()], ["basins.png"])


if __name__ == "__main__":
    unittest.main()

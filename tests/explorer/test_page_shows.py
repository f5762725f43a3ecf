"""What a report shows of an atlas, in headless Chromium."""
import json
import re
import subprocess
import sys
import unittest
import xml.etree.ElementTree

import h5py
import numpy as np
from explorer_test import PAGE, ExplorerTest, cell, columns
from reports import PROGRAM, ROOT, TINY, made, run
from selenium.webdriver.common.keys import Keys

sys.path.insert(0, str(ROOT / "tools"))

import rubatlas.atlas  # noqa: E402, F401  # with xarray, which reports with orbits then find imported
from rubatlas.report import orbits  # noqa: E402

SVG = "{http://www.w3.org/2000/svg}"
HOSTILE = "</script><script>window.intruder=1</script><img src=x onerror=\"window.intruder=1\"> & Ω"


class PageShows(ExplorerTest):
    # --- opening ---

    def test_a_report_opens_from_a_file_without_an_error(self):
        self.open()
        self.assertEqual(self.browser.log(), [])
        self.assertEqual(self.browser.dataset("computer"), "there")
        self.assertEqual(self.browser.text("h1"), "Tiny atlas")

    def test_one_thing_is_counted_as_one(self):
        atlas = run(self.folder, "one", {
            "grid": {"speed_ratio": [0.3]}, "blades": {"count": 1}, "observables": ["poincare"],
            "protocol": {"transient_revolutions": 1, "sampled_revolutions": 1}})
        self.open(report=made(self.folder / "one.html", atlas, "--without-solver", "--orbits", "1", solver=False))
        self.assertEqual(self.browser.text("#summary"), "1 point · law elastica, 1 blade")
        self.assertIn("computed those of 1 point from", self.browser.text("#not-computed"))
        self.assertIn("1 revolution of transient, 1 sampled", self.browser.text("#tables"))

    def test_the_title_of_a_scene_cannot_inject_markup(self):
        atlas = run(self.folder, "hostile",
                    {"title": HOSTILE, "reference": HOSTILE, "grid": {"speed_ratio": [0.3, 0.6]},
                     "protocol": {"transient_revolutions": 5, "sampled_revolutions": 4}})
        self.open(report=made(self.folder / "hostile.html", atlas))
        self.assertEqual(self.browser.text("h1"), HOSTILE)
        self.assertEqual(self.browser.text("#reference"), HOSTILE)
        self.assertIsNone(self.browser.run("return window.intruder"))
        self.assertEqual(self.browser.run("return document.querySelectorAll('img').length"), 0)
        picture = xml.etree.ElementTree.parse(self.browser.exported("SVG", "map"))
        self.assertEqual([one.tag for one in picture.iter() if one.tag.endswith("script") or one.get("onerror")], [])
        self.assertEqual(self.browser.log(), [])

    def test_every_kind_of_atlas_opens(self):
        for name, options in (("rings", ["--maps", TINY / "rings_maps.h5"]),
                              ("basins", ["--maps", TINY / "basins_maps.h5"]), ("gravity", ["--orbits", "4"])):
            with self.subTest(name):
                self.open(report=made(self.folder / f"{name}.html", TINY / f"{name}.h5", *options))
                self.press(Keys.ARROW_RIGHT)
                self.assertEqual(self.browser.log(), [])

    def test_table_1_says_of_every_line_where_blades_touch(self):
        atlas, report = self.analysed("free", {
            "rotor": {"misalignment": 0.005}, "unbalance": {"moment": 5e-4},
            "grid": {"speed_ratio": {"from": 0.3, "to": 0.9, "count": 31}, "damping_ratio": [0.05, 0.3]},
            "protocol": {"transient_revolutions": 40, "sampled_revolutions": 8}})
        self.open(report=report)
        table = self.browser.text("#tables table")
        with h5py.File(atlas.with_name("free_maps.h5")) as file:
            for sentence in file["table1/contact"]:
                self.assertRegex(sentence.decode(), "^no contact; closest ")
                self.assertIn("N" + sentence.decode()[1:].replace("; ", "\n"), table)
        self.assertNotIn("aperiodic", table, "no regions where nothing touches")
        self.assertEqual(self.browser.log(), [])

    def test_a_page_without_the_solver_says_so_and_shows_the_orbits_of_the_program(self):
        with h5py.File(TINY / "gravity.h5") as atlas:
            done = np.flatnonzero(atlas["status"][...] == 1)
            place = np.unravel_index(orbits.spread(done, 3)[1], atlas["status"].shape)
            at = ",".join(f"{axis}={float(atlas[axis][index])!r}"
                          for axis, index in zip(("damping_ratio", "speed_ratio"), place[-2:]))
        self.open("#at=" + at, made(self.folder / "gravity.html", TINY / "gravity.h5", "--orbits", "3",
                                    "--without-solver", solver=False))
        self.assertIn("made without the solver", self.browser.text("#not-computed"))
        self.assertTrue(self.browser.find("#not-computed").is_displayed())
        self.assertFalse(self.browser.find("#own").is_displayed())
        self.assertEqual(self.browser.facts()["Status"], "done")
        self.assertGreater(len(columns(self.browser.exported("CSV", "poincare"))["atlas_x [m]"]), 0)
        self.assertEqual(self.browser.text("#chart-orbit .badge"), "computed by the program")
        orbit = self.folder / "gravity_orbit.h5"
        subprocess.run([PROGRAM, "orbit", ROOT / "tests/tools/gravity.json", "--at", at, "--from", TINY / "gravity.h5",
                        "-o", orbit],
                       check=True, capture_output=True)
        shown = columns(self.browser.exported("CSV", "rotor"))
        with h5py.File(orbit) as file:
            last, stride = len(shown["tau"]), max(1, len(file["time"]) // len(file["sections"]) // 128)
            for part, name in enumerate(("x [m]", "y [m]", "vx [m per unit of tau]", "vy [m per unit of tau]")):
                np.testing.assert_allclose(np.array(shown[name], float), file["state"][::stride, part][-last:],
                                           rtol=1e-6, atol=1e-9)
            np.testing.assert_allclose(np.array(shown["force_of_blade_1 [N]"], float),
                                       file["force"][::stride, 0][-last:], rtol=1e-6)
        before = self.browser.pixels("#rotor")
        self.browser.find("#play").click()
        self.browser.wait_for("Number(document.getElementById('rotor').dataset.time) > 0.2")
        self.browser.find("#play").click()
        self.assertNotEqual(self.browser.pixels("#rotor"), before)
        self.assertEqual(self.browser.log(), [])

    def bold_lines(self, picture):
        """The corners of the lines of a picture that are three pixels wide."""
        return [np.array([place.split() for place in one.get("d")[1:].split("L")], float)
                for one in xml.etree.ElementTree.parse(picture).iter() if one.get("stroke-width") == "3"]

    def test_the_rotor_turns_as_a_swept_ripple_of_the_speed_makes_it(self):
        atlas = run(self.folder, "ripple", {
            "speed_ripple": {"amplitude": 0.1, "order": 1},
            "grid": {"speed_ratio": [0.45], "/speed_ripple/amplitude": [0.05, 0.4]},
            "protocol": {"transient_revolutions": 20, "sampled_revolutions": 8}})
        report = made(self.folder / "ripple.html", atlas, "--orbits", "2", "--without-solver", solver=False)
        for amplitude in 0.05, 0.4:
            with self.subTest(amplitude):
                self.open(f"#at=speed_ratio=0.45,speed_ripple_amplitude={amplitude}", report)
                self.assertEqual(self.browser.text("#chart-orbit .badge"), "computed by the program")
                for _ in range(3):  # a blade that has just touched down is straight: its tip lies on the ring
                    self.browser.find("#step").click()
                    touching = int(re.search(r"in contact: blade (\d)", self.browser.text("#rotor-status"))[1])
                    ring, *blades = self.bold_lines(self.browser.exported("SVG", "rotor"))
                    self.assertEqual(len(blades), 3)
                    middle = 0.5 * (ring.min(axis=0) + ring.max(axis=0))
                    self.assertAlmostEqual(np.hypot(*(blades[touching - 1][-1] - middle)),
                                           np.hypot(*(ring[0] - middle)), delta=0.2)  # pixels, of 187
        self.assertEqual(self.browser.log(), [])

    def without_web_assembly(self):
        script = self.browser.command("Page.addScriptToEvaluateOnNewDocument", source="delete window.WebAssembly")
        self.addCleanup(self.browser.command, "Page.removeScriptToEvaluateOnNewDocument", **script)

    def test_a_point_whose_orbit_is_not_in_the_report_names_the_nearest_that_is(self):
        self.without_web_assembly()
        self.open(report=made(self.folder / "two_orbits.html", TINY / "atlas.h5", "--maps", TINY / "maps.h5",
                              "--orbits", "2"))
        self.assertIn("orbits from the program, which computed those of 2 points", self.browser.text("#not-computed"))
        self.open(cell(1, 17), self.folder / "two_orbits.html")
        self.assertRegex(self.browser.text("#rotor-status"),
                         "no orbit of this point; the nearest with one: .*Ω\\s0[.][0-9]+")
        self.assertEqual(self.browser.log(), [])

    def test_without_web_assembly_all_that_comes_from_the_atlas_works(self):
        self.without_web_assembly()
        self.open()
        self.assertEqual(self.browser.dataset("computer"), "none")
        self.assertIn("runs no WebAssembly", self.browser.text("#not-computed"))
        before = self.browser.facts()
        self.click_cell(0.3, 0.5)
        self.assertNotEqual(self.browser.facts(), before)
        self.assertEqual(len(columns(self.browser.exported("CSV", "poincare"))["atlas_x [m]"]), 16)
        self.assertEqual(self.browser.log(), [])

    # --- the map ---

    def test_a_click_on_a_cell_opens_its_point_in_every_panel(self):
        self.show()
        panels = ["#chart-bifurcation canvas", "#chart-poincare canvas", "#chart-orbit canvas", "#chart-forces canvas",
                  "#chart-spectrum canvas",
                  "#chart-waterfall canvas", "#rotor", "#map canvas"]
        before = [self.browser.pixels(panel) for panel in panels]
        facts = self.browser.facts()
        self.click_cell(0.6, 0.5)
        self.assertNotEqual(self.browser.facts()["Speed ratio Ω"], facts["Speed ratio Ω"])
        for panel, picture in zip(panels, before):
            with self.subTest(panel):
                self.assertNotEqual(self.browser.pixels(panel), picture)
        self.assertEqual(self.browser.log(), [])

    def test_the_waterfall_has_each_line_at_its_frequency(self):
        with h5py.File(TINY / "atlas.h5") as file:
            amplitudes, orders = file["spectrum"][0, 0, 0, 1, 20], file["order"][...]
            speeds = file["speed_ratio"][...]
        self.show(cell(1, 4))
        half = 0.5 * (speeds[1] - speeds[0])
        share = (speeds[20] - speeds[0] + half) / (speeds[-1] - speeds[0] + 2.0 * half)
        pixels = self.browser.run("""
            const [canvas, area] = ['canvas', '.u-over'].map((part) =>
              document.querySelector(`#chart-waterfall ${part}`));
            const [all, over] = [canvas, area].map((part) => part.getBoundingClientRect());
            const scale = canvas.width / all.width;
            const across = over.left - all.left + arguments[0] * over.width, down = over.top - all.top;
            return Array.from(canvas.getContext('2d')
              .getImageData(scale * across, scale * down, 1, scale * over.height).data)""", share)
        red, green, blue = np.array(pixels).reshape(-1, 4)[::-1, :3].T
        yellow = red + green - 2 * blue  # the largest amplitudes; the dashes of whole orders are white
        top = min(orders[-1] * speeds[-1], 4.0)
        frequency = top * (np.arange(yellow.size) + 0.5) / yellow.size
        vibrates = frequency > 0.5 * speeds[20]
        strongest = orders[1:][amplitudes[1:].argmax()] * speeds[20]
        self.assertAlmostEqual(frequency[vibrates][yellow[vibrates].argmax()], strongest, delta=speeds[20] / 16)

    def test_the_facts_of_a_cell_are_those_of_the_atlas(self):
        self.show_maps(cell(1, 17))
        with h5py.File(TINY / "atlas.h5") as file:
            self.assertEqual(file["status"][0, 0, 0, 1, 17], 1)
            displacement, force = (file[name][0, 0, 0, 1, 17] for name in ("max_displacement", "max_contact_force"))
        facts = self.browser.facts()
        self.assertEqual(facts["Max displacement"], f"{float(f'{1e3 * displacement:.4g}'):g} mm")
        self.assertEqual(facts["Max contact force"], f"{float(f'{force:.4g}'):g} N")

    def test_arrow_keys_walk_over_the_map(self):
        self.show_maps(cell(1, 10))
        self.browser.computes(lambda: self.press(Keys.ARROW_RIGHT))
        self.assertTrue(self.browser.driver.current_url.endswith(cell(1, 11)[1:]), self.browser.driver.current_url)
        self.browser.computes(lambda: self.press(Keys.ARROW_UP))
        self.assertTrue(self.browser.driver.current_url.endswith(cell(2, 11)[1:]), self.browser.driver.current_url)

    def test_the_address_shows_a_colleague_the_same_view(self):
        self.show_maps(cell(1, 10))
        self.click_cell(0.75, 0.9)
        self.browser.run("const s = document.getElementById('map-quantity'); s.value = 'max_displacement'; "
                         "s.onchange()")
        address, facts = self.browser.driver.current_url, self.browser.facts()
        picture = self.browser.pixels("#map canvas")
        self.open("#" + address.split("#")[1], self.maps_alone)
        self.assertEqual(self.browser.facts(), facts)
        self.assertEqual(self.browser.pixels("#map canvas"), picture)

    def test_an_address_that_asks_for_nonsense_opens_the_page(self):
        for address in ("#where=constructor > 1", "#where=" + 4000 * "(", "#x=damping_ratio&y=damping_ratio",
                        "#x=damping_ratio", "#at=9,9,9,9,9", "#at=" + 5000 * "a,"):
            with self.subTest(address[:30]):
                self.show_maps(address)
                self.assertNotEqual(*(self.browser.run(f"return document.getElementById('map-{side}').value")
                                      for side in "xy"))
                self.assertEqual(self.browser.facts()["Status"], "done")
                self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), 1400)
        self.assertEqual(self.browser.log(), [])

    def test_keys_that_follow_each_other_at_once_end_at_the_last_points_own_sections(self):
        self.show(cell(1, 17))
        self.browser.run("document.activeElement.blur()")
        self.browser.computes(lambda: self.browser.run(
            "for (const key of ['ArrowUp', 'ArrowDown']) "
            "document.body.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true}))"), times=2)
        table = columns(self.browser.exported("CSV", "poincare"))
        with h5py.File(TINY / "atlas.h5") as atlas:
            np.testing.assert_allclose(np.array(table["atlas_x [m]"], float),
                                       atlas["poincare"][0, 0, 0, 1, 17, -16:, 0], rtol=1e-6)

    def test_every_quantity_is_drawn_over_every_pair_of_axes(self):
        self.open(report=self.of_maps("rings", TINY / "rings.h5", "--maps", TINY / "rings_maps.h5"))
        pictures = set()
        for quantity in self.browser.run("return [...document.getElementById('map-quantity').options]"
                                         ".map((one) => one.value)"):
            self.browser.run("const s = document.getElementById('map-quantity'); s.value = arguments[0]; s.onchange()",
                             quantity)
            pictures.add(self.browser.pixels("#map canvas"))
        for number in self.browser.run("return [...document.getElementById('map-x').options].map((one) => one.value)"):
            self.browser.run("const s = document.getElementById('map-x'); s.value = arguments[0]; s.onchange()", number)
            pictures.add(self.browser.pixels("#map canvas"))
        self.assertGreater(len(pictures), 4)
        self.assertEqual(self.browser.log(), [])

    def hatched(self, word):
        """The share of the map whose cells are hatched as the legend's entry of this word."""
        drawing = xml.etree.ElementTree.parse(self.browser.exported("SVG", "map")).getroot()
        groups = [one for one in drawing.iter(f"{SVG}g") if one.get("clip-path")]
        clip = {f"url(#{one.get('id')})": one[0].get("d") for one in drawing.iter(f"{SVG}clipPath")}

        def area(group):
            boxes = re.findall(r"M([-\d.]+) ([-\d.]+)H([-\d.]+)V([-\d.]+)", clip[group.get("clip-path")])
            left, top, right, bottom = np.array(boxes, float).T
            return ((right - left) * (bottom - top)).sum()

        def pattern(group):
            """Directions of the lines; none for dots."""
            path = group[0]
            lines = re.findall(r"M([-\d.]+) ([-\d.]+)L([-\d.]+) ([-\d.]+)", path.get("d"))
            return {np.sign((x2 - x1) * (y2 - y1)) for x1, y1, x2, y2 in np.array(lines, float)}
        whole = next(one for one in groups if len(list(one)) > 1)
        legend = next(one for one in drawing.iter(f"{SVG}g") if one.get("transform") and
                      [text.text for text in one.findall(f"{SVG}text")] == [word])
        mark = next(one for one in legend.iter(f"{SVG}g") if one.get("clip-path"))
        same = [one for one in whole.iter(f"{SVG}g") if one is not whole and one.get("clip-path")
                and pattern(one) == pattern(mark)]
        self.assertLessEqual(len(same), 1)
        return area(same[0]) / area(whole) if same else 0.0

    def test_points_without_a_motion_are_hatched_in_every_map(self):
        with h5py.File(TINY / "atlas.h5") as atlas:
            left = float((atlas["status"][...] == 2).mean())
        self.assertGreater(left, 0.05)
        for quantity in ("class", "max_displacement", "status"):
            with self.subTest(quantity):
                self.show_maps(f"#map={quantity}")
                self.assertAlmostEqual(self.hatched("left the model's validity"), left, delta=2e-3)

    def test_a_map_of_many_cells_is_hatched_where_and_only_where_there_is_no_motion(self):
        atlas = run(self.folder, "many", {
            "grid": {"speed_ratio": {"from": 0.1, "to": 0.2, "count": 40},
                     "damping_ratio": {"from": 0.1, "to": 0.2, "count": 20}},
            "protocol": {"transient_revolutions": 0, "sampled_revolutions": 1}, "observables": ["max_displacement"]})
        for count in (800, 60):  # cells in every other column, as separate boxes
            with h5py.File(atlas, "r+") as file:
                status = np.ones((20, 40), "u1")
                status[:, ::2] = 2
                status.ravel()[count:] = 1
                file["status"][...] = status.reshape(file["status"].shape)
            self.open("#map=status&at=speed_ratio=0.2,damping_ratio=0.2",
                      self.of_maps(f"many_{count}", atlas))
            dark = np.array(self.browser.run("""
                const canvas = document.querySelector('#map canvas'), over = document.querySelector('#map .u-over');
                const [from, inner] = [canvas, over].map((one) => one.getBoundingClientRect());
                const [wide, tall] = [inner.width / 40, inner.height / 20];
                const context = canvas.getContext('2d');
                return Array.from({length: 20}, (_, j) => Array.from({length: 40}, (_, i) => {
                  const [left, top] = [inner.left - from.left + i * wide, inner.bottom - from.top - (j + 1) * tall];
                  const {data} = context.getImageData(left + 1, top + 1, wide - 2, tall - 2);
                  return data.filter((_, at) => at % 4 === 0).some((red) => red < 120);
                }))"""))
            dark[-1, -1] = False  # the selected cell has a frame
            with self.subTest(count):
                np.testing.assert_array_equal(dark, status == 2)

    def analysed(self, name, scene):
        """The report of an atlas of a scene, and of its maps."""
        atlas = run(self.folder, name, {"protocol": {"transient_revolutions": 20, "sampled_revolutions": 4}, **scene})
        maps = self.folder / f"{name}_maps.h5"
        subprocess.run([PROGRAM, "analyse", atlas, "-o", maps, "--overwrite"], check=True, capture_output=True)
        return atlas, self.of_maps(name, atlas, "--maps", maps)

    def test_where_nothing_touches_the_map_of_classes_is_hatched_and_its_legend_says_so(self):
        atlas, report = self.analysed("untouched", {
            "rotor": {"misalignment": 0.005}, "unbalance": {"moment": 4e-3},
            "grid": {"speed_ratio": {"from": 0.3, "to": 0.9, "count": 13}, "damping_ratio": [0.1, 0.3]},
            "observables": ["max_displacement", "poincare", "contact_fraction"]})
        with h5py.File(atlas) as file:
            untouched = float(((file["status"][...] == 1) & (file["contact_fraction"][...] == 0)).mean())
        self.assertGreater(untouched, 0.2)
        self.assertLess(untouched, 0.95)
        self.open(report=report)
        self.assertAlmostEqual(self.hatched("no blade touches"), untouched, delta=2e-3)
        self.assertIn("no blade touches", self.browser.text("#map-legend"))
        self.browser.go("#map=max_displacement")
        self.assertNotIn("no blade touches", self.browser.text("#map-legend"))

    def test_cells_that_are_narrower_than_a_pixel_are_named_and_told_apart_by_zooming(self):
        atlas = run(self.folder, "columns", {
            "grid": {"speed_ratio": {"from": 0.1, "to": 0.999, "count": 900}},
            "protocol": {"transient_revolutions": 0, "sampled_revolutions": 2}, "observables": ["max_displacement"]})
        with h5py.File(atlas) as file:
            displacement, speed = file["max_displacement"][...].ravel(), file["speed_ratio"][...]
        self.open("#map=max_displacement&at=speed_ratio=0.5", self.of_maps("columns", atlas))
        area = self.browser.find("#map .u-over")
        self.assertLess(area.size["width"], 600)

        def tip(across=0):
            self.acts().move_to_element_with_offset(area, across, 0).perform()
            return self.browser.text("#map .tip").replace("\xa0", " ")

        def named(text):
            return int(np.argmin(np.abs(speed - float(re.search(r"Ω ([0-9.]+)", text)[1]))))
        for place in (-150, 0, 150):
            text = tip(place)
            self.assertIn("one of 2 cells in this pixel", text)
            self.assertIn(f"max displacement: {float(f'{1e3 * displacement[named(text)]:.4g}'):g} mm", text)
        for _ in range(7):
            self.browser.find("#map-nearer").click()
        area = self.browser.find("#map .u-over")
        self.assertNotIn("in this pixel", tip())
        seen = [named(tip(across)) for across in range(-area.size["width"] // 2 + 5, area.size["width"] // 2 - 5, 10)]
        self.assertEqual(sorted(set(seen)), list(range(min(seen), max(seen) + 1)))
        self.assertIn(int(np.argmin(np.abs(speed - 0.5))), seen)
        self.assertLess(len(set(seen)), 12)
        # A walk out of the part that is shown takes the part along.
        self.browser.computes(lambda: self.press(12 * Keys.ARROW_RIGHT), times=12)
        self.assertIn(int(np.argmin(np.abs(speed - 0.5))) + 12,
                      range(named(tip(5 - area.size["width"] // 2)), named(tip(area.size["width"] // 2 - 5)) + 1))
        self.browser.find("#map-whole").click()
        self.assertIn("one of 2 cells in this pixel", tip())

    def test_sweep_directions_are_words(self):
        _, report = self.analysed("both",
                                  {"sweep": "both", "grid": {"speed_ratio": {"from": 0.3, "to": 0.7, "count": 9}}})
        self.open("#at=direction=down,speed_ratio=0.4", report)
        self.assertEqual(self.browser.facts()["Direction"], "down")
        lines = self.browser.run("return [...document.querySelectorAll('#tables table')].map((table) => "
                                 "[table.tHead.textContent, ...[...table.tBodies[0].rows].map((row) => "
                                 "row.cells[0].textContent)])")
        self.assertIn(["up", "down"], [cells for heading, *cells in lines if heading.startswith("Direction")])
        self.assertEqual(set(columns(self.browser.exported("CSV", "map"))["direction"]), {"up", "down"})
        self.assertIn("direction=down", self.browser.driver.current_url)

    # --- links ---

    def notice(self):
        return self.browser.text("#address-notice") if self.browser.find("#address-notice").is_displayed() else ""

    def test_a_link_holds_values_by_name_or_symbol(self):
        self.show_maps(cell(1, 17))
        facts = self.browser.facts()
        with h5py.File(TINY / "atlas.h5") as atlas:
            speed = float(atlas["speed_ratio"][17])
        self.assertEqual(facts["Damping ratio ζ"], "0.1")
        self.assertEqual(self.notice(), "")
        self.show_maps(f"#at=ζ=0.1,Ω={speed!r}")
        self.assertEqual(self.browser.facts(), facts)
        self.assertEqual(self.notice(), "")

    def test_what_a_link_asks_for_and_is_not_there_is_said(self):
        with h5py.File(TINY / "atlas.h5") as atlas:
            speed = float(atlas["speed_ratio"][17])
        for address, said in (
                ("#at=speed_ratio=7", "speed_ratio=7 is outside 0.2 to 0.9"),
                (f"#at=speed_ratio={speed + 0.003}", f"is between points; the nearest is {speed!r}"),
                ("#at=0,0,0,1,17", "0 is no name=value"), ("#at=speed_ratio=fast", "speed_ratio=fast is outside"),
                ("#at=sped_ratio=0.4", "sped_ratio is none of thickness"), ("#map=clas", "map=clas is no quantity"),
                ("#x=time", "x=time is no axis"), ("#zoom=3", "zoom is none of map"),
                ("#from=here", "from=here is neither"),
                ("#own=friction=3", "friction=3 is outside 0 to 2"), ("#own=0.6,0.1", "0.6 is no name=value")):
            with self.subTest(address):
                self.show_maps(address)
                self.assertIn(said, self.notice())
                self.assertEqual(self.browser.text("#origin"), "from the atlas")
        self.browser.computes(lambda: self.press(Keys.ARROW_RIGHT))
        self.assertEqual(self.notice(), "")

    def test_the_way_back_leads_over_what_was_chosen(self):
        self.show_maps(cell(1, 10))
        first = self.browser.facts()
        self.click_cell(0.75, 0.9)
        second = self.browser.facts()
        self.assertNotEqual(first, second)
        for _ in range(3):
            self.browser.computes(lambda: self.press(Keys.ARROW_LEFT))
        third = self.browser.facts()
        self.assertNotEqual(second, third)
        for act, facts in ((self.browser.driver.back, second), (self.browser.driver.back, first),
                           (self.browser.driver.forward, second)):
            self.browser.computes(act)
            self.assertEqual(self.browser.facts(), facts)

    # --- queries ---

    def test_a_query_marks_the_points_of_which_it_is_true(self):
        self.show_maps()
        plain = self.browser.pixels("#map canvas")
        field = self.browser.find("#query")
        field.send_keys("class = period 1 and max displacement > 5 mm", Keys.ENTER)
        with h5py.File(TINY / "atlas.h5") as atlas, h5py.File(TINY / "maps.h5") as maps:
            done = int((atlas["status"][...] == 1).sum())
            expected = int(((maps["class"][...] == 1) & (atlas["max_displacement"][...] > 5e-3) &
                            (atlas["status"][...] == 1)).sum())
        self.assertGreater(expected, 0)
        self.assertTrue(self.browser.text("#query-answer").startswith(f"{expected} of {done} points that are done "),
                        self.browser.text("#query-answer"))
        self.assertNotEqual(self.browser.pixels("#map canvas"), plain)
        self.assertIn("where=", self.browser.driver.current_url)

    def test_a_query_is_echoed_in_units_and_its_names_are_listed(self):
        self.show_maps()
        self.browser.find("#query").send_keys("max displacement > 0.25 and 60 rpm >= speed", Keys.ENTER)
        self.assertRegex(self.browser.text("#query-answer"),
                         r"^0 of \d+ points that are done are marked: max_displacement > 250 mm, 25 clearances; "
                         r"speed_ratio <= 0.628319, 60 rpm, 1 Hz\.$")
        self.browser.find("#query").clear()
        self.browser.find("#query").send_keys("max displacement > 0.25 N", Keys.ENTER)
        self.assertIn("a length, what stands after it is a force", self.browser.text("#query-answer"))
        named = self.browser.text("#query-help")
        for word in ("max_displacement", "speed_ratio", "aperiodic", "rpm", "clearances"):
            self.assertIn(word, named)

    def test_a_query_with_an_unknown_name_says_which_is_nearest(self):
        self.show_maps()
        self.browser.find("#query").send_keys("max_displacment > 1", Keys.ENTER)
        self.assertIn("nearest name is max_displacement", self.browser.text("#query-answer"))

    def test_queries_mean_what_the_table_of_cases_says(self):
        table = json.loads((ROOT / "tests/explorer/query_cases.json").read_text())
        grammar = json.loads((ROOT / "tools/rubatlas/query_grammar.json").read_text())
        self.show_nothing()
        for cases in (table["cases"], table["trees"]):
            found = self.browser.run((PAGE / "query.js").read_text() + """
                const [names, sizes, cases, grammar] = [...arguments].map((text) => JSON.parse(text));
                const known = Object.fromEntries(Object.entries(names).map(([name, {values, units, flags}]) =>
                  [name, {of: (point) => values[point] ?? NaN, units, flags: flags ?? null}]));
                const large = Object.fromEntries(Object.entries(sizes).map(([name, values]) =>
                  [name, (point) => values[point]]));
                return cases.map(({query, tree}) => {
                  try {
                    if (tree) return {query, tree: queryTree(query, grammar)};
                    const holds = parseQuery(query, known, grammar, large);
                    return {query, holds: [0, 1, 2, 3].map((point) => Boolean(holds(point)))};
                  } catch (error) {
                    if (!(error instanceof QueryError)) throw error;
                    return {query, error: error.message.replace(/no unit; .*/, 'no unit; UNITS')};
                  }
                });""", *map(json.dumps, (table["names"], table["sizes"], cases, grammar)))  # in the order as written
            self.assertEqual(len(found), len(cases))
            for answer, case in zip(found, cases):
                with self.subTest(case["query"]):
                    self.assertEqual(answer, case)


if __name__ == "__main__":
    unittest.main()

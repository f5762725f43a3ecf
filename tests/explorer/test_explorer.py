"""What a report shows and computes, in headless Chromium."""
import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

import h5py
import numpy as np
from browser import Browser
from reports import PROGRAM, ROOT, TINY, WITHOUT_SOLVER, made, run, tiny
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

sys.path.insert(0, str(ROOT / "tools"))

from rubatlas import elastica  # noqa: E402
from rubatlas.report import contents, orbits  # noqa: E402

PAGE = ROOT / "tools/rubatlas/report/page"
CLEARANCE = 0.01  # m, of the default rotor
# What the page and the program may differ by on periodic points, in clearances: methods and compilers differ, the
# equations do not.
AGREEMENT = 1e-9
HOSTILE = "</script><script>window.intruder=1</script><img src=x onerror=\"window.intruder=1\"> & Ω"


def columns(path):
    """A saved table: its columns by name, without what is empty."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return {name: [row[i] for row in rows[1:] if row[i] != ""] for i, name in enumerate(rows[0])}


class Explorer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if WITHOUT_SOLVER:
            raise unittest.SkipTest(WITHOUT_SOLVER)
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = pathlib.Path(holder.name)
        cls.report = tiny(cls.folder)
        downloads = cls.folder / "downloads"
        downloads.mkdir()
        cls.browser = Browser(downloads)
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        self.browser.resize(1400)
        self.browser.command("Emulation.setEmulatedMedia", features=[])
        self.browser.log()

    def open(self, address="", report=None):
        self.browser.open(report or self.report, address)

    def click_cell(self, across, down):
        """Clicks the map at shares of its width and height."""
        area = self.browser.find("#map .u-over")
        x, y = (across - 0.5) * area.size["width"], (down - 0.5) * area.size["height"]
        there = ActionChains(self.browser.driver).move_to_element_with_offset(area, x, y)
        self.browser.computes(lambda: there.click().perform())

    def press(self, *keys):
        ActionChains(self.browser.driver).send_keys(*keys).perform()

    def computed_sections(self):
        table = columns(self.browser.exported("CSV", "poincare"))
        return np.array([list(map(float, table["computed_x_mm"])), list(map(float, table["computed_y_mm"]))]).T * 1e-3

    def own(self, **values):
        """The address of a point of its own, started from the initial state."""
        usual = {"speed_ratio": 0.62, "damping_ratio": 0.1, "friction": 0.1, "unbalance": 0.0, "thickness": 0.001,
                 "misalignment": 0.01001}
        return "#from=initial&own=" + ",".join(repr(value) for value in {**usual, **values}.values())

    # --- opening ---

    def test_a_report_opens_from_a_file_without_an_error(self):
        self.open()
        self.assertEqual(self.browser.log(), [])
        self.assertEqual(self.browser.dataset("computer"), "there")
        self.assertEqual(self.browser.text("h1"), "Tiny atlas")

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

    def test_where_the_solver_does_not_know_the_scene_the_page_says_so_and_shows_the_orbits_of_the_program(self):
        with h5py.File(TINY / "gravity.h5") as atlas:
            done = np.flatnonzero(atlas["status"][...] == 1)
            place = np.unravel_index(orbits.spread(done, 3)[1], atlas["status"].shape)
            at = ",".join(f"{axis}={float(atlas[axis][index])!r}"
                          for axis, index in zip(("damping_ratio", "speed_ratio"), place[-2:]))
        self.open("#at=" + ",".join(map(str, place)),
                  made(self.folder / "gravity.html", TINY / "gravity.h5", "--orbits", "3"))
        self.assertIn("gravity", self.browser.text("#not-computed"))
        self.assertTrue(self.browser.find("#not-computed").is_displayed())
        self.assertFalse(self.browser.find("#own").is_displayed())
        self.assertEqual(self.browser.facts()["Status"], "done")
        self.assertGreater(len(columns(self.browser.exported("CSV", "poincare"))["atlas_x_mm"]), 0)
        self.assertEqual(self.browser.text("#chart-orbit .badge"), "computed by the program")
        orbit = self.folder / "gravity_orbit.h5"
        subprocess.run([PROGRAM, "orbit", ROOT / "tests/tools/gravity.json", "--at", at, "--from", TINY / "gravity.h5",
                        "-o", orbit],
                       check=True, capture_output=True)
        shown = columns(self.browser.exported("CSV", "rotor"))
        with h5py.File(orbit) as file:
            last, stride = len(shown["tau"]), max(1, len(file["time"]) // len(file["sections"]) // 128)
            for part, name in enumerate(("x_m", "y_m", "vx_m", "vy_m")):
                np.testing.assert_allclose(np.array(shown[name], float), file["state"][::stride, part][-last:],
                                           rtol=1e-6, atol=1e-9)
            np.testing.assert_allclose(np.array(shown["force_of_blade_1_N"], float), file["force"][::stride, 0][-last:],
                                       rtol=1e-6)
        before = self.browser.pixels("#rotor")
        self.browser.find("#play").click()
        self.browser.wait_for("Number(document.getElementById('rotor').dataset.time) > 0.2")
        self.browser.find("#play").click()
        self.assertNotEqual(self.browser.pixels("#rotor"), before)
        self.assertEqual(self.browser.log(), [])

    def without_web_assembly(self):
        script = self.browser.command("Page.addScriptToEvaluateOnNewDocument", source="delete window.WebAssembly")
        self.addCleanup(self.browser.command, "Page.removeScriptToEvaluateOnNewDocument", **script)

    def test_a_point_whose_orbit_is_not_in_the_report_names_the_nearest_that_is(self):
        self.without_web_assembly()
        self.open(report=made(self.folder / "two_orbits.html", TINY / "atlas.h5", "--maps", TINY / "maps.h5",
                              "--orbits", "2"))
        self.assertIn("orbits from the program, which computed those of 2 points", self.browser.text("#not-computed"))
        self.open("#at=0,0,0,1,17", self.folder / "two_orbits.html")
        self.assertRegex(self.browser.text("#rotor-status"),
                         "no orbit of this point; the nearest with one: .*Ω 0[.][0-9]+")
        self.assertEqual(self.browser.log(), [])

    def test_without_web_assembly_all_that_comes_from_the_atlas_works(self):
        self.without_web_assembly()
        self.open()
        self.assertEqual(self.browser.dataset("computer"), "none")
        self.assertIn("runs no WebAssembly", self.browser.text("#not-computed"))
        before = self.browser.facts()
        self.click_cell(0.3, 0.5)
        self.assertNotEqual(self.browser.facts(), before)
        self.assertEqual(len(columns(self.browser.exported("CSV", "poincare"))["atlas_x_mm"]), 16)
        self.assertEqual(self.browser.log(), [])

    # --- the map ---

    def test_a_click_on_a_cell_opens_its_point_in_every_panel(self):
        self.open()
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

    def test_the_facts_of_a_cell_are_those_of_the_atlas(self):
        self.open("#at=0,0,0,1,17")
        with h5py.File(TINY / "atlas.h5") as file:
            self.assertEqual(file["status"][0, 0, 0, 1, 17], 1)
            displacement, force = (file[name][0, 0, 0, 1, 17] for name in ("max_displacement", "max_contact_force"))
        facts = self.browser.facts()
        self.assertEqual(facts["Max displacement"], f"{float(f'{1e3 * displacement:.4g}'):g} mm")
        self.assertEqual(facts["Max contact force"], f"{float(f'{force:.4g}'):g} N")

    def test_arrow_keys_walk_over_the_map(self):
        self.open("#at=0,0,0,1,10")
        self.browser.computes(lambda: self.press(Keys.ARROW_RIGHT))
        self.assertIn("at=0%2C0%2C0%2C1%2C11", self.browser.driver.current_url)
        self.browser.computes(lambda: self.press(Keys.ARROW_UP))
        self.assertIn("at=0%2C0%2C0%2C2%2C11", self.browser.driver.current_url)

    def test_the_address_shows_a_colleague_the_same_view(self):
        self.open("#at=0,0,0,1,10")
        self.click_cell(0.75, 0.9)
        self.browser.run("const s = document.getElementById('map-quantity'); s.value = 'max_displacement'; "
                         "s.onchange()")
        address, facts = self.browser.driver.current_url, self.browser.facts()
        picture = self.browser.pixels("#map canvas")
        self.open("#" + address.split("#")[1])
        self.assertEqual(self.browser.facts(), facts)
        self.assertEqual(self.browser.pixels("#map canvas"), picture)

    def test_an_address_that_asks_for_nonsense_opens_the_page(self):
        for address in ("#where=constructor > 1", "#where=" + 4000 * "(", "#x=damping_ratio&y=damping_ratio",
                        "#x=damping_ratio", "#at=9,9,9,9,9"):
            with self.subTest(address[:30]):
                self.open(address)
                self.assertNotEqual(*(self.browser.run(f"return document.getElementById('map-{side}').value")
                                      for side in "xy"))
                self.assertEqual(self.browser.facts()["Status"], "done")
        self.assertEqual(self.browser.log(), [])

    def test_keys_that_follow_each_other_at_once_end_at_the_last_points_own_sections(self):
        self.open("#at=0,0,0,1,17")
        self.browser.run("document.activeElement.blur()")
        self.browser.computes(lambda: self.browser.run(
            "for (const key of ['ArrowUp', 'ArrowDown']) "
            "document.body.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true}))"), times=2)
        table = columns(self.browser.exported("CSV", "poincare"))
        with h5py.File(TINY / "atlas.h5") as atlas:
            np.testing.assert_allclose(np.array(table["atlas_x_mm"], float),
                                       1e3 * atlas["poincare"][0, 0, 0, 1, 17, -16:, 0], rtol=1e-6)

    def test_every_quantity_is_drawn_over_every_pair_of_axes(self):
        self.open(report=made(self.folder / "rings.html", TINY / "rings.h5", "--maps", TINY / "rings_maps.h5"))
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

    # --- queries ---

    def test_a_query_marks_the_points_of_which_it_is_true(self):
        self.open()
        plain = self.browser.pixels("#map canvas")
        field = self.browser.find("#query")
        field.send_keys("class == 'period 1' and max_displacement > 5e-3", Keys.ENTER)
        with h5py.File(TINY / "atlas.h5") as atlas, h5py.File(TINY / "maps.h5") as maps:
            done = int((atlas["status"][...] == 1).sum())
            expected = int(((maps["class"][...] == 1) & (atlas["max_displacement"][...] > 5e-3) &
                            (atlas["status"][...] == 1)).sum())
        self.assertGreater(expected, 0)
        self.assertTrue(self.browser.text("#query-answer").startswith(f"{expected} of {done} points that are done "),
                        self.browser.text("#query-answer"))
        self.assertNotEqual(self.browser.pixels("#map canvas"), plain)
        self.assertIn("where=", self.browser.driver.current_url)

    def test_a_query_with_an_unknown_name_says_which_is_nearest(self):
        self.open()
        self.browser.find("#query").send_keys("max_displacment > 1", Keys.ENTER)
        self.assertIn("nearest name is max_displacement", self.browser.text("#query-answer"))

    def test_queries_mean_what_the_table_of_cases_says(self):
        table = json.loads((ROOT / "tests/explorer/query_cases.json").read_text())
        grammar = json.loads((ROOT / "tools/rubatlas/query_grammar.json").read_text())
        extension = table["extension"]
        extended = {**grammar, **extension, "tokens": {**grammar["tokens"], **extension["tokens"]}}
        self.browser.driver.get("about:blank")
        for cases, known in ((table["cases"], grammar), (table["cases_of_the_extension"], extended),
                             (table["trees"], grammar)):
            found = self.browser.run((PAGE / "query.js").read_text() + """
                const [names, cases, grammar] = [...arguments].map((text) => JSON.parse(text));
                const known = Object.fromEntries(Object.entries(names).map(([name, {values, flags}]) =>
                  [name, {of: (point) => values[point] ?? NaN, flags: flags ?? null}]));
                return cases.map(({query, tree}) => {
                  try {
                    if (tree) return {query, tree: queryTree(query, grammar)};
                    const holds = parseQuery(query, known, grammar);
                    return {query, holds: [0, 1, 2, 3].map((point) => Boolean(holds(point)))};
                  } catch (error) {
                    if (!(error instanceof QueryError)) throw error;
                    return {query, error: error.message};
                  }
                });""", *map(json.dumps, (table["names"], cases, known)))  # in the order in which they are written
            self.assertEqual(len(found), len(cases))
            for answer, case in zip(found, cases):
                with self.subTest(case["query"]):
                    self.assertEqual(answer, case)

    # --- computing ---

    def expect_agreement(self, report, name, scene, address):
        """The page's sections of a point are the program's."""
        protocol = {"transient_revolutions": 30, "sampled_revolutions": 64}
        atlas = run(self.folder, name,
                    {**scene, "sweep": "independent", "protocol": protocol, "observables": ["poincare"]})
        with h5py.File(atlas) as file:
            self.assertEqual(file["status"][...].ravel().tolist(), [1])
            expected = file["poincare"][...].reshape(64, 4)[:, :2]
        self.open(address, report)
        self.assertIn("computed in this page", self.browser.text("#origin"))
        np.testing.assert_allclose(self.computed_sections() / CLEARANCE, expected / CLEARANCE, rtol=0, atol=AGREEMENT)

    def test_a_point_off_the_grid_agrees_with_the_program(self):
        self.expect_agreement(self.report, "off_the_grid", {
            "rotor": {"damping_ratio": 0.13, "misalignment": 0.01002}, "blades": {"thickness": 0.0011},
            "contact": {"friction": 0.15},
            "grid": {"speed_ratio": [0.6234]}}, self.own(speed_ratio=0.6234, damping_ratio=0.13, misalignment=0.01002,
                                                         thickness=0.0011, friction=0.15))

    def test_a_point_with_unbalance_agrees_with_the_program(self):
        self.expect_agreement(self.report, "unbalanced",
                              {"unbalance": {"moment": 2e-6}, "grid": {"speed_ratio": [0.63]}},
                              self.own(speed_ratio=0.63, unbalance=2e-6))

    def test_a_point_on_an_elastic_ring_agrees_with_the_program(self):
        law = {"contact": {"law": "elastic_ring", "friction": 0.1}}
        atlas = run(self.folder, "ring", {**law, "grid": {"speed_ratio": [0.6, 0.64]},
                                          "protocol": {"transient_revolutions": 30, "sampled_revolutions": 8}})
        self.expect_agreement(made(self.folder / "ring.html", atlas), "on_ring",
                              {**law, "unbalance": {"moment": 1e-6}, "grid": {"speed_ratio": [0.62]}},
                              self.own(speed_ratio=0.62, unbalance=1e-6))

    def test_a_periodic_cell_goes_on_in_the_page_as_the_atlas_has_it(self):
        with h5py.File(TINY / "atlas.h5") as atlas, h5py.File(TINY / "maps.h5") as maps:
            periodic = (maps["class"][0, 0, 0, 1] == 1) & (atlas["max_contact_force"][0, 0, 0, 1] > 1.0)
            place = int(np.flatnonzero(periodic)[0])
            section = atlas["poincare"][0, 0, 0, 1, place, -1, :2]
        self.open(f"#at=0,0,0,1,{place}")
        # What the maps call period 1 repeats within 1e-6 of its size.
        self.assertLess(np.abs(self.computed_sections() - section).max(), 2e-6 * np.linalg.norm(section))

    def test_a_slider_asks_for_a_new_point_and_the_way_back_leads_to_the_cell(self):
        self.open("#at=0,0,0,1,17")
        facts = self.browser.facts()
        slider = self.browser.find("[data-own=friction]")
        slider.click()
        self.browser.computes(lambda: slider.send_keys(Keys.ARROW_RIGHT))
        self.assertIn("computed in this page", self.browser.text("#origin"))
        self.assertNotEqual(self.browser.facts()["Friction μ"], facts.get("Friction μ"))
        self.assertIn("own=", self.browser.driver.current_url)
        self.browser.computes(lambda: self.browser.find("#back").click())
        self.assertEqual(self.browser.facts(), facts)
        self.assertNotIn("own=", self.browser.driver.current_url)

    def test_a_value_outside_its_range_is_refused_in_words(self):
        self.open()
        field = self.browser.find("[data-own-number=friction]")
        field.clear()
        field.send_keys("2.5", Keys.ENTER)
        self.assertIn("2.5 is outside [0, 2]", self.browser.text("#own-status"))
        self.assertIn("from the atlas", self.browser.text("#origin"))

    def test_more_revolutions_add_sections_where_the_last_ended(self):
        self.open(self.own(speed_ratio=0.4))
        first = self.computed_sections()
        self.browser.computes(lambda: self.browser.find("#more").click())
        second = self.computed_sections()
        self.assertEqual(len(second), 2 * len(first))
        np.testing.assert_array_equal(second[:len(first)], first)

    def test_a_motion_that_leaves_the_model_says_what_ended_it(self):
        self.open(self.own(speed_ratio=1.15))
        self.assertRegex(self.browser.facts()["Status"],
                         "left off in revolution [0-9]+: .*(equilibrium|shortened|ring)")

    # --- the animation ---

    def test_the_rotor_moves_while_it_plays_and_stands_while_it_does_not(self):
        self.open("#at=0,0,0,1,17")
        self.assertEqual(self.browser.run("return document.getElementById('rotor').dataset.time"), "0")
        before = self.browser.pixels("#rotor")
        self.browser.find("#play").click()
        self.browser.wait_for("Number(document.getElementById('rotor').dataset.time) > 0.2")
        self.browser.find("#play").click()
        stopped = self.browser.run("return document.getElementById('rotor').dataset.time")
        self.assertNotEqual(self.browser.pixels("#rotor"), before)
        self.browser.wait_for_two_frames()
        self.assertEqual(self.browser.run("return document.getElementById('rotor').dataset.time"), stopped)

    def test_a_step_leads_to_the_next_touch_down(self):
        self.open("#at=0,0,0,1,17")
        forces = columns(self.browser.exported("CSV", "forces"))
        starts = [float(time) for time, force, before in zip(forces["tau"], forces["blade"], ["", *forces["blade"]])
                  if force != before]
        self.browser.find("#step").click()
        at = float(self.browser.run("return document.getElementById('rotor').dataset.time"))
        self.assertLess(min(abs(start - at) for start in starts), 1e-3)
        self.assertIn("in contact", self.browser.text("#rotor-status"))
        self.browser.find("#step").click()
        self.assertGreater(float(self.browser.run("return document.getElementById('rotor').dataset.time")), at)

    def test_the_shape_of_a_blade_ends_where_the_closed_form_says(self):
        excess = np.array([1e-3, 0.05, 0.3])
        self.browser.driver.get("about:blank")
        for friction in (0.02, 0.1, 1.0):
            for load, shortening, deflection in zip(*elastica.curve(friction, excess)):
                for side in (1.0, -1.0):
                    # The orbit says the load; that the tip is on the ring says the side. A picture is a thousand pixels
                    # wide.
                    points = self.browser.run((PAGE / "elastica.js").read_text() + """
                        const [table, load, friction, deflection] = arguments;
                        return bentBlade(table, load, friction, [1, -1], ([along, across]) => across - deflection)
                        """, contents.shapes_of_blades(), load, friction, side * deflection)
                    self.assertAlmostEqual(points[-1][0], 1 - shortening, delta=1e-3)
                    self.assertAlmostEqual(points[-1][1], side * deflection, delta=1e-3)

    def test_a_blade_without_friction_stands_straight_below_the_load_of_euler(self):
        self.browser.driver.get("about:blank")
        for share, bent in ((0.0, False), (0.99, False), (1.1, True)):
            across = self.browser.run((PAGE / "elastica.js").read_text() +
                                      "return bladeShape(...arguments).map(([, across]) => across)",
                                      contents.shapes_of_blades(), share * elastica.EULER_LOAD, 0.0)
            self.assertEqual(max(across) > 0.2, bent)
            self.assertTrue(bent or max(across) == 0.0)

    # --- files ---

    def test_every_panel_saves_a_picture_a_drawing_and_its_numbers(self):
        self.open("#at=0,0,0,1,17")
        for panel in ("map", "rotor", "bifurcation", "poincare", "orbit", "forces", "spectrum", "waterfall"):
            with self.subTest(panel):
                self.assertEqual(self.browser.exported("PNG", panel).read_bytes()[:4], b"\x89PNG")
                drawing = xml.etree.ElementTree.parse(self.browser.exported("SVG", panel)).getroot()
                self.assertGreater(len(list(drawing.iter())), 10)
                self.assertGreater(max(map(len, columns(self.browser.exported("CSV", panel)).values())), 1)

    def test_saved_numbers_have_all_digits_of_the_atlas(self):
        self.open("#map=max_displacement")
        table = columns(self.browser.exported("CSV", "map"))
        with h5py.File(TINY / "atlas.h5") as file:
            values, done = file["max_displacement"][...].ravel(), file["status"][...].ravel() == 1
        self.assertEqual([float(text) for text in table["max_displacement"]], values[done].tolist())

    # --- languages, sizes, colours, keys ---

    def test_numbers_follow_the_language_of_the_browser_and_files_do_not(self):
        self.addCleanup(self.browser.command, "Emulation.setLocaleOverride")
        for language, mark in (("de-DE", ","), ("fr-FR", ","), ("en-GB", ".")):
            with self.subTest(language):
                self.browser.command("Emulation.setLocaleOverride", locale=language)
                self.open("#at=0,0,0,1,17")
                self.assertRegex(self.browser.facts()["Max displacement"], rf"^\d+{re.escape(mark)}\d+ mm$")
                for text in columns(self.browser.exported("CSV", "map"))["speed_ratio"]:
                    self.assertRegex(text, r"^\d(\.\d+)?$")

    def test_a_narrow_screen_shows_everything_without_scrolling_sideways(self):
        self.browser.resize(380, 800)
        self.open("#at=0,0,0,1,17")
        self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), 380)
        for panel in ("#map", "#rotor", "#own", "#chart-orbit", "#chart-waterfall", "#tables"):
            width = self.browser.run("return document.querySelector(arguments[0]).getBoundingClientRect().right", panel)
            self.assertLessEqual(width, 380, panel)
        self.click_cell(0.4, 0.5)
        self.assertEqual(self.browser.log(), [])

    def test_a_dark_screen_has_a_dark_page(self):
        def brightness():
            return sum(map(int,
                           re.findall(r"\d+",
                                      self.browser.run("return getComputedStyle(document.body).backgroundColor"))[:3]))
        self.open("#at=0,0,0,1,17")
        light, picture = brightness(), self.browser.pixels("#chart-orbit canvas")
        self.browser.command("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
        self.open("#at=0,0,0,1,17")
        self.assertGreater(light, 600)
        self.assertLess(brightness(), 150)
        self.assertNotEqual(self.browser.pixels("#chart-orbit canvas"), picture)

    def test_everything_is_reached_by_keyboard_alone(self):
        self.open("#at=0,0,0,1,17")
        wanted = {"map", "map-quantity", "map-x", "map-y", "query", "play", "step", "rate", "zoom", "trail",
                  "own-start", "more"}
        reached = set()
        for _ in range(120):
            self.press(Keys.TAB)
            reached.add(self.browser.run("return document.activeElement.id"))
            self.assertTrue(self.browser.run("return document.activeElement === document.body || "
                                             "getComputedStyle(document.activeElement).outlineStyle !== 'none'"),
                            self.browser.run("return document.activeElement.outerHTML.slice(0, 80)"))
        self.assertLessEqual(wanted, reached)
        self.browser.run("document.activeElement.blur()")
        self.press("q")
        self.assertEqual(self.browser.run("return document.activeElement.id"), "query")
        self.press(Keys.ESCAPE, " ")
        self.assertEqual(self.browser.text("#play"), "Pause")

    def test_every_control_has_a_name(self):
        self.open()
        nameless = self.browser.run("""
            return [...document.querySelectorAll('input, select, button, canvas[role], [tabindex]')]
                .filter((one) => !one.getAttribute('aria-label') && !one.labels?.length && !one.textContent.trim() &&
                    !one.closest('[aria-label]'))
                .map((one) => one.outerHTML)""")
        self.assertEqual(nameless, [])


if __name__ == "__main__":
    unittest.main()

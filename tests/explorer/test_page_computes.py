"""What a report computes by itself, and the rotor that it moves, in headless Chromium."""
import json
import re
import sys
import unittest

import h5py
import numpy as np
from explorer_test import PAGE, ExplorerTest, cell, columns
from reports import ROOT, TINY, made, run
from selenium.webdriver.common.keys import Keys

sys.path.insert(0, str(ROOT / "tools"))

from rubatlas import elastica  # noqa: E402
from rubatlas.report import contents  # noqa: E402

CLEARANCE = 0.01  # m, of the default rotor
# What the page and the program may differ by on periodic points, in clearances: compilers and libraries differ, the
# equations do not.
AGREEMENT = 1e-9
# Every effect, with others as far as they combine: each but release and stick moves the sections by more than that.
TOGETHER = (("ring_body", "axial_compliance", "unequal_blades", "speed_ripple"),
            ("wear", "speed_ramp", "load_direction"), ("stick", "unbalance", "support"),
            ("stick_elastica", "side_load", "gravity"), ("release", "yielding_ring"), ("stribeck",),
            ("regularised_friction",), ("contact_damping",))


class PageComputes(ExplorerTest):
    # --- computing ---

    def expect_sections(self, atlas, atol=AGREEMENT):
        """The page's sections are those of the atlas' only point."""
        with h5py.File(atlas) as file:
            self.assertEqual(file["status"][...].ravel().tolist(), [1])
            expected = file["poincare"][...].reshape(64, 4)[:, :2]
        np.testing.assert_allclose(self.computed_sections() / CLEARANCE, expected / CLEARANCE, rtol=0, atol=atol)

    def of_one_point(self, name, scene, transient=30):
        protocol = {"transient_revolutions": transient, "sampled_revolutions": 64}
        return run(self.folder, name, {**scene, "protocol": protocol, "observables": ["poincare"]})

    def expect_agreement(self, report, name, scene, address):
        """The page's sections of a point off the grid are the program's."""
        atlas = self.of_one_point(name, scene)
        self.open(address, report)
        self.assertIn("computed in this page", self.browser.text("#origin"))
        self.expect_sections(atlas)

    def of_effects(self, *effects):
        """The scene of effects that act together, at a speed where their motion is periodic."""
        scene = {}
        for effect in effects:
            scene |= json.loads((ROOT / f"jobs/effect_{effect}.json").read_text())
        scene.pop("spectrum", None)
        return {**scene, "grid": {"speed_ratio": [0.15]}, "accuracy": {"tolerance": 1e-11}}

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

    def test_points_with_each_effect_agree_with_the_program(self):
        for effects in TOGETHER:
            with self.subTest(effects):
                atlas = self.of_one_point(effects[0], self.of_effects(*effects))
                self.open("#from=initial", made(self.folder / f"{effects[0]}.html", atlas))
                self.expect_sections(atlas)
        self.assertEqual(sorted(effect for effects in TOGETHER for effect in effects),
                         sorted(path.stem.removeprefix("effect_") for path in (ROOT / "jobs").glob("effect_*.json")))

    def test_the_page_goes_on_from_what_effects_remember(self):
        for effect, undrawn in (("ring_body", "the ring at rest"), ("wear", "blades without their wear")):
            with self.subTest(effect):
                atlas = self.of_one_point(f"{effect}_before", self.of_effects(effect))
                self.open(report=made(self.folder / f"{effect}_before.html", atlas))
                self.assertEqual(self.browser.text("#not-computed"), f"The moving rotor is drawn with {undrawn}.")
                self.expect_sections(self.of_one_point(f"{effect}_after", self.of_effects(effect), transient=94), 1e-8)

    def test_a_periodic_cell_goes_on_in_the_page_as_the_atlas_has_it(self):
        with h5py.File(TINY / "atlas.h5") as atlas, h5py.File(TINY / "maps.h5") as maps:
            periodic = (maps["class"][0, 0, 0, 1] == 1) & (atlas["max_contact_force"][0, 0, 0, 1] > 1.0)
            place = int(np.flatnonzero(periodic)[0])
            section = atlas["poincare"][0, 0, 0, 1, place, -1, :2]
        self.show(cell(1, place))
        # What the maps call period 1 repeats within 1e-6 of its size.
        self.assertLess(np.abs(self.computed_sections() - section).max(), 2e-6 * np.linalg.norm(section))

    def test_a_slider_asks_for_a_new_point_and_the_way_back_leads_to_the_cell(self):
        self.show(cell(1, 4))
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
        self.browser.computes(lambda: slider.send_keys(Keys.ARROW_RIGHT))
        self.assertIn("own=", self.browser.driver.current_url)
        self.browser.computes(self.browser.driver.back)
        self.assertEqual(self.browser.facts(), facts)

    def test_a_value_outside_its_range_is_refused_in_words(self):
        self.show()
        field = self.browser.find("[data-own-number=friction]")
        field.clear()
        field.send_keys("2.5", Keys.ENTER)
        self.assertIn("2.5 is outside [0, 2]", self.browser.text("#own-status"))
        self.assertIn("from the atlas", self.browser.text("#origin"))

    def test_more_revolutions_add_sections_where_the_last_ended(self):
        self.show(self.own(speed_ratio=0.4))
        first = self.computed_sections()
        self.browser.computes(lambda: self.browser.find("#more").click())
        second = self.computed_sections()
        self.assertEqual(len(second), 2 * len(first))
        np.testing.assert_array_equal(second[:len(first)], first)

    def test_more_revolutions_of_a_run_up_go_on_at_the_speed_it_has_reached(self):
        scene = self.of_effects("speed_ramp")
        self.open("#from=initial", made(self.folder / "run_up.html", self.of_one_point("run_up", scene)))
        self.browser.computes(lambda: self.browser.find("#more").click())
        whole = run(self.folder, "run_up_on", {**scene, "observables": ["poincare"], "protocol": {
            "transient_revolutions": 30, "sampled_revolutions": 128}})
        with h5py.File(whole) as file:
            expected = file["poincare"][...].reshape(128, 4)[:, :2]
        np.testing.assert_allclose(self.computed_sections() / CLEARANCE, expected / CLEARANCE, rtol=0, atol=1e-8)

    def test_a_motion_that_leaves_the_model_says_what_ended_it(self):
        self.show(self.own(speed_ratio=1.5))
        self.assertRegex(self.browser.facts()["Status"],
                         "left off in revolution [0-9]+: .*(equilibrium|shortened|ring)")

    def test_a_start_that_the_misalignment_puts_beyond_the_ring_says_so_and_offers_the_initial_state(self):
        self.show(cell(1, 17) + "&own=misalignment=0.09")
        status = self.browser.facts()["Status"]
        self.assertRegex(status, "the start lies [0-9.]+ mm beyond the ring; ")
        said = float(re.search("lies ([0-9.]+) mm", status)[1])
        with h5py.File(TINY / "atlas.h5") as file:
            x, y = file["final_state"][0, 0, 0, 1, 17, :2]
        self.assertAlmostEqual(said, 1e3 * (np.hypot(x, y + 0.09) - CLEARANCE), delta=0.01)
        self.assertIn("beyond the ring", self.browser.text("#own-status"))
        self.assertIn("beyond the ring", self.browser.text("#chart-orbit .note"))
        self.browser.computes(lambda: self.browser.find("#from-initial").click())
        self.assertIn("from the scene’s initial state", self.browser.text("#own-status"))
        self.assertIn("from=initial", self.browser.driver.current_url)
        self.assertFalse(self.browser.find("#from-initial").is_displayed())

    def test_a_motion_that_leaves_the_model_from_within_the_ring_is_not_said_to_start_beyond_it(self):
        self.show(self.own(speed_ratio=1.5))
        self.assertNotIn("the start lies", self.browser.facts()["Status"])

    # --- the animation ---

    def test_the_rotor_moves_while_it_plays_and_stands_while_it_does_not(self):
        self.show(cell(1, 17))
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
        self.show(cell(1, 17))
        forces = columns(self.browser.exported("CSV", "forces"))
        # Samples of a contact are close together.
        times, blades = np.array(forces["tau"], float), np.array(forces["blade"], int)
        starts = times[np.r_[True, (np.diff(blades) != 0) | (np.diff(times) > 0.1)]]
        self.browser.find("#step").click()
        at = float(self.browser.run("return document.getElementById('rotor').dataset.time"))
        self.assertLess(np.abs(starts - at).min(), 1e-3)
        self.assertIn("in contact", self.browser.text("#rotor-status"))
        self.browser.find("#step").click()
        self.assertGreater(float(self.browser.run("return document.getElementById('rotor').dataset.time")), at)

    def test_the_shape_of_a_blade_ends_where_the_closed_form_says(self):
        excess = np.array([1e-3, 0.05, 0.3])
        self.show_nothing()
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
        self.show_nothing()
        for share, bent in ((0.0, False), (0.99, False), (1.1, True)):
            across = self.browser.run((PAGE / "elastica.js").read_text() +
                                      "return bladeShape(...arguments).map(([, across]) => across)",
                                      contents.shapes_of_blades(), share * elastica.EULER_LOAD, 0.0)
            self.assertEqual(max(across) > 0.2, bent)
            self.assertTrue(bent or max(across) == 0.0)


if __name__ == "__main__":
    unittest.main()

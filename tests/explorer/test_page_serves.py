"""How a report serves its reader: what it saves, languages, sizes, colours, keys, in headless Chromium."""
import re
import unittest
import xml.etree.ElementTree

import h5py
from explorer_test import ExplorerTest, columns
from reports import TINY
from selenium.webdriver.common.keys import Keys


class PageServes(ExplorerTest):
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

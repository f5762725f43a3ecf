"""How a report serves its reader: what it saves, languages, sizes, colours, keys, in headless Chromium."""
import html
import re
import struct
import unittest
import xml.etree.ElementTree

import h5py
from explorer_test import ExplorerTest, cell, columns
from reports import TINY
from selenium.webdriver.common.keys import Keys

SVG = "{http://www.w3.org/2000/svg}"


class PageServes(ExplorerTest):
    # --- files ---

    def test_every_panel_saves_a_picture_with_three_pixels_for_each_of_the_screen(self):
        self.show(cell(1, 17))
        drawn = {"map": "#map canvas", "orbit": "#chart-orbit canvas"}
        for panel in self.PANELS:
            with self.subTest(panel):
                picture = self.browser.exported("PNG", panel).read_bytes()
                self.assertEqual(picture[:4], b"\x89PNG")
                if panel in drawn:
                    width, = struct.unpack(">I", picture[16:20])
                    shown = self.browser.run("return document.querySelector(arguments[0]).clientWidth", drawn[panel])
                    self.assertEqual(width, 3 * shown)

    def test_saved_numbers_have_all_digits_of_the_atlas(self):
        self.show_maps("#map=max_displacement")
        table = columns(self.browser.exported("CSV", "map"))
        with h5py.File(TINY / "atlas.h5") as file:
            values, done = file["max_displacement"][...].ravel(), file["status"][...].ravel() == 1
        self.assertEqual([float(text) for text in table["max_displacement [m]"]], values[done].tolist())

    OF_LINES = ("map", "bifurcation", "waterfall")
    PANELS = (*OF_LINES, "rotor", "poincare", "orbit", "forces", "spectrum")

    def drawn_words(self, panel):
        """All texts of a drawing, without the spaces at which lines end."""
        drawing = xml.etree.ElementTree.parse(self.browser.exported("SVG", panel)).getroot()
        self.assertGreater(len(list(drawing.iter())), 10)
        return re.sub(r"\s", "", "".join("".join(text.itertext()) for text in drawing.iter(f"{SVG}text")))

    def test_pictures_of_the_atlas_beside_an_own_point_are_titled_with_what_they_show(self):
        self.show(cell(1, 17) + "&own=friction=0.37,damping_ratio=0.123")
        for panel in self.OF_LINES:
            with self.subTest(panel):
                words = self.drawn_words(panel)
                self.assertNotIn("0.37", words)
                self.assertNotIn("0.123", words)
                self.assertIn("μ0.1", words)
        self.assertIn("ζ0.1", self.drawn_words("waterfall"))
        for panel in ("rotor", "poincare", "orbit", "forces", "spectrum"):
            with self.subTest(panel):
                self.assertIn("ζ0.123,μ0.37", self.drawn_words(panel))

    def test_titles_and_legends_of_pictures_are_within_them_on_a_narrow_screen(self):
        self.browser.resize(380, 800)
        self.open(cell(1, 17))
        drawings = {panel: self.browser.exported("SVG", panel).read_text() for panel in self.PANELS}
        legends = {"map": "left the model's validity", "rotor": "path of the shaft’s centre",
                   "bifurcation": "sections of the atlas", "poincare": "computed here", "orbit": "64 revolutions",
                   "forces": "blade 2", "spectrum": "of the atlas", "waterfall": "orders 1, 2, 3"}
        self.show_nothing()
        for panel, drawing in drawings.items():
            with self.subTest(panel):
                self.assertIn(legends[panel], html.unescape(drawing))
                size, *boxes = self.browser.run("""
                    document.body.innerHTML = arguments[0];
                    const outer = document.querySelector('svg');
                    return [[outer.width.baseVal.value, outer.height.baseVal.value],
                        ...[...outer.querySelectorAll('text')].map((text) => {
                          const frame = outer.getBoundingClientRect(), box = text.getBoundingClientRect();
                          return [text.textContent, box.left - frame.left, box.top - frame.top,
                            box.right - frame.left, box.bottom - frame.top];
                        })]""", drawing)
                for words, left, top, right, bottom in boxes:
                    self.assertTrue(0 <= left and right <= size[0] and 0 <= top and bottom <= size[1], words)

    def test_saved_tables_have_si_units_in_their_headers_and_name_their_point(self):
        atlas, own = {"friction": 0.1}, {"speed_ratio": 0.6234, "friction": 0.15, "thickness": 0.0011}
        of_own = cell(1, 17) + "&own=" + ",".join(f"{name}={value}" for name, value in own.items())
        for address, values in ((cell(1, 17), atlas), (of_own, own)):
            self.show(address)
            for panel in self.PANELS:
                with self.subTest(f"{address} {panel}"):
                    path = self.browser.exported("CSV", panel)
                    said = [line[2:] for line in path.read_text().splitlines() if line.startswith("# ")]
                    table = columns(path)
                    self.assertGreater(max(map(len, table.values())), 1)
                    for name in table:
                        self.assertRegex(name, r"^[a-z_]+([0-9][0-9.]*)?( \[(m|kg m|N|m per unit of tau)\])?$")
                    self.assertIn("atlas.h5", said[1])
                    facts = dict(line.split(" = ") for line in said[2:])
                    for name, value in (atlas if panel in self.OF_LINES else values).items():
                        unit = " [m]" if name == "thickness" else ""
                        self.assertEqual(float(facts[name + unit]), value)

    # --- languages, sizes, colours, keys ---

    def test_controls_have_the_size_of_a_finger_where_one_points(self):
        def sizes():
            self.show(cell(1, 17))
            return self.browser.run("""
                return [...document.querySelectorAll('button, select, input, summary')]
                    .filter((one) => one.offsetParent).map((one) => {
                      const {width, height} = one.getBoundingClientRect();
                      return [one.id || one.getAttribute('aria-label') || one.outerHTML.slice(0, 80), width, height];
                    })""")
        self.assertLess(min(min(width, height) for _, width, height in sizes()), 24)
        self.addCleanup(self.browser.command, "Emulation.setTouchEmulationEnabled", enabled=False)
        self.browser.command("Emulation.setTouchEmulationEnabled", enabled=True)
        for screen in (1400, 380):
            self.browser.resize(screen)
            for name, width, height in sizes():
                with self.subTest(f"{name} at {screen}"):
                    self.assertGreaterEqual(min(width, height), 24)
            self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), screen)

    def test_numbers_follow_the_language_of_the_browser_and_files_do_not(self):
        self.addCleanup(self.browser.command, "Emulation.setLocaleOverride")
        for language, mark in (("de-DE", ","), ("fr-FR", ","), ("en-GB", ".")):
            with self.subTest(language):
                self.browser.command("Emulation.setLocaleOverride", locale=language)
                self.open(cell(1, 17), self.maps_alone)
                self.assertRegex(self.browser.facts()["Max displacement"], rf"^\d+{re.escape(mark)}\d+ mm$")
                for text in columns(self.browser.exported("CSV", "map"))["speed_ratio"]:
                    self.assertRegex(text, r"^\d(\.\d+)?$")

    def test_a_narrow_screen_shows_everything_without_scrolling_sideways(self):
        for screen in (320, 380):
            self.browser.resize(screen, 800)
            self.open(cell(1, 17))
            self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), screen)
            for panel in ("#map", "#rotor", "#own", "#chart-orbit", "#chart-waterfall", "#tables"):
                right = self.browser.run("return document.querySelector(arguments[0]).getBoundingClientRect().right",
                                         panel)
                self.assertLessEqual(right, screen, panel)
        self.click_cell(0.4, 0.5)
        self.assertEqual(self.browser.log(), [])

    def test_a_dark_screen_has_a_dark_page(self):
        def brightness():
            return sum(map(int,
                           re.findall(r"\d+",
                                      self.browser.run("return getComputedStyle(document.body).backgroundColor"))[:3]))
        self.show(cell(1, 17))
        light, picture = brightness(), self.browser.pixels("#chart-orbit canvas")
        self.browser.command("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
        self.open(cell(1, 17))
        self.assertGreater(light, 600)
        self.assertLess(brightness(), 150)
        self.assertNotEqual(self.browser.pixels("#chart-orbit canvas"), picture)

    def test_everything_is_reached_by_keyboard_alone(self):
        self.show(cell(1, 17))
        wanted = {"map", "map-quantity", "map-x", "map-y", "query", "play", "step", "rate", "zoom", "trail",
                  "own-start", "more"}
        reached = set()
        for _ in range(120):
            self.press(Keys.TAB)
            name, seen, element = self.browser.run("""
                const {activeElement: one, body} = document;
                return [one.id, one === body || getComputedStyle(one).outlineStyle !== 'none',
                        one.outerHTML.slice(0, 80)]""")
            reached.add(name)
            self.assertTrue(seen, element)
        self.assertLessEqual(wanted, reached)
        self.browser.run("document.activeElement.blur()")
        self.press("q")
        self.assertEqual(self.browser.run("return document.activeElement.id"), "query")
        self.press(Keys.ESCAPE, " ")
        self.assertEqual(self.browser.text("#play"), "Pause")
        self.press(" ")
        self.assertEqual(self.browser.text("#play"), "Play")

    def test_every_control_has_a_name(self):
        self.show()
        nameless = self.browser.run("""
            return [...document.querySelectorAll('input, select, button, canvas[role], [tabindex]')]
                .filter((one) => !one.getAttribute('aria-label') && !one.labels?.length && !one.textContent.trim() &&
                    !one.closest('[aria-label]'))
                .map((one) => one.outerHTML)""")
        self.assertEqual(nameless, [])

    def test_screen_readers_hear_what_every_picture_shows_and_every_value(self):
        self.show(cell(1, 17))
        self.browser.command("Accessibility.enable")
        self.addCleanup(self.browser.command, "Accessibility.disable")
        nodes = [node for node in self.browser.command("Accessibility.getFullAXTree")["nodes"] if not node["ignored"]]
        name = {role: [node["name"]["value"] for node in nodes if node["role"]["value"] == role]
                for role in ("image", "slider", "button", "combobox", "spinbutton", "application", "alert", "region")}
        for role, names in name.items():
            self.assertNotIn("", names, role)
        pictures = " ".join(name["image"]).replace("\xa0", " ")
        for heading in ("Class · h 1 mm", "Sections over the speed", "Poincaré section · ", "Orbit of the shaft · ",
                        "Forces on the blades", "Spectrum of x", "Waterfall", "The rotor in its ring"):
            self.assertIn(heading, pictures)
        spoken = self.browser.run("return [...document.querySelectorAll('input[type=range]')]"
                                  ".map((one) => one.getAttribute('aria-valuetext') || '')")
        self.assertNotIn("", spoken)
        self.assertLessEqual({"10.01 mm", "4 s a revolution"}, set(spoken))
        self.assertIn("period 1", self.browser.text("#map canvas"))
        self.assertIn("Selected: ", self.browser.text("#map-here"))


if __name__ == "__main__":
    unittest.main()

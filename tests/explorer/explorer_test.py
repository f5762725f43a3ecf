"""What tests of a report in headless Chromium share."""
import csv
import pathlib
import tempfile
import unittest

import h5py
import numpy as np
from browser import Browser
from reports import ROOT, TINY, WITHOUT_SOLVER, made, tiny
from selenium.webdriver.common.action_chains import ActionChains

PAGE = ROOT / "tools/rubatlas/report/page"


def columns(path):
    """A saved table: its columns by name, without what is empty."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    return {name: [row[i] for row in rows[1:] if row[i] != ""] for i, name in enumerate(rows[0])}


def cell(*places):
    """The address of a cell of the tiny atlas, by its places on the axes of the damping ratio and the speed ratio."""
    with h5py.File(TINY / "atlas.h5") as atlas:
        return "#at=" + ",".join(f"{axis}={float(atlas[axis][place])!r}"
                                 for axis, place in zip(("damping_ratio", "speed_ratio"), places))


class ExplorerTest(unittest.TestCase):
    """Of a browser in which the report of the tiny atlas is opened."""

    @classmethod
    def setUpClass(cls):
        if WITHOUT_SOLVER:
            raise unittest.SkipTest(WITHOUT_SOLVER)
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = pathlib.Path(holder.name)
        cls.report = tiny(cls.folder)
        cls.maps_alone = cls.of_maps("tiny", TINY / "atlas.h5", "--maps", TINY / "maps.h5")
        downloads = cls.folder / "downloads"
        downloads.mkdir()
        cls.browser = Browser(downloads)
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        self.browser.resize(1400)
        self.browser.command("Emulation.setEmulatedMedia", features=[])
        self.browser.log()

    @classmethod
    def of_maps(cls, name, atlas, *options):
        """A report for a look at its maps: without solver and orbits it opens in a third of the time."""
        return made(cls.folder / f"{name}_maps.html", atlas, "--without-solver", "--orbits", "0", *options,
                    solver=False)

    shown = None  # the report that the browser has as `show` leaves it

    def open(self, address="", report=None):
        ExplorerTest.shown = None
        self.browser.open(report or self.report, address)

    def show(self, address="", report=None):
        """The report of the tiny atlas at an address: in the page that the test before has shown, by a link that is
        pasted into it, which takes a tenth of the time. For tests that leave nothing in the page but its address."""
        report = report or self.report
        if ExplorerTest.shown == report:
            self.browser.go(address)
        else:
            self.open(address, report)
        ExplorerTest.shown = report

    def show_nothing(self):
        """A page without a report, for a script that is tested alone."""
        ExplorerTest.shown = None
        self.browser.driver.get("about:blank")

    def show_maps(self, address=""):
        """The same of the report without solver, for what is asked of maps and links: nothing is computed then."""
        self.show(address, self.maps_alone)

    def acts(self):
        """What mouse and keys do, without the quarter of a second for which Selenium moves the mouse otherwise."""
        return ActionChains(self.browser.driver, duration=0)

    def click_cell(self, across, down):
        """Clicks the map at shares of its width and height."""
        area = self.browser.find("#map .u-over")
        x, y = (across - 0.5) * area.size["width"], (down - 0.5) * area.size["height"]
        there = self.acts().move_to_element_with_offset(area, x, y)
        self.browser.computes(lambda: there.click().perform())

    def press(self, *keys):
        self.acts().send_keys(*keys).perform()

    def computed_sections(self):
        table = columns(self.browser.exported("CSV", "poincare"))
        return np.array([list(map(float, table[f"computed_{component} [m]"])) for component in "xy"]).T

    def own(self, **values):
        """The address of a point of its own, started from the initial state."""
        usual = {"speed_ratio": 0.62, "damping_ratio": 0.1, "friction": 0.1, "unbalance": 0.0, "thickness": 0.001,
                 "misalignment": 0.01001}
        return "#from=initial&own=" + ",".join(f"{name}={value!r}" for name, value in {**usual, **values}.items())

"""The palette: classes and points without a motion are told apart in greyscale and by people who see fewer colours."""
import itertools
import json
import os
import pathlib
import re
import sys
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
TINY = pathlib.Path(os.environ["RUBATLAS_PROGRAM"]).parent / "tests/tiny_atlas"
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "analysis"), str(ROOT / "tests/support")]
from forked_commands import ended_command  # noqa: E402
from paper import statement_map  # noqa: E402
from rubatlas.palette import PALETTE  # noqa: E402

# What is left of linear RGB: G. M. Machado, M. M. Oliveira, L. A. F. Fernandes, A physiologically-based model for
# simulation of color vision deficiency, IEEE Transactions on Visualization and Computer Graphics 15 (2009) 1291-1298,
# severity 1.0.
SIGHTS = {
    "normal": np.eye(3),
    "protanopia": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deuteranopia": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413],
                     [-0.011820, 0.042940, 0.968881]],
    "tritanopia": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
}
# Of linear sRGB (IEC 61966-2-1).
TO_XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
# Two colours side by side differ visibly from a distance of about 2.3 on; a patch of a map is compared with a legend
# far away, which asks for ten times as much. In greyscale six classes share the 100 units between black and white.
LEAST_DISTANCE, LEAST_LIGHTNESS = 25.0, 12.0


def colour_in(sight, colour):
    """CIELAB of a colour #rrggbb as people with this sight see it; the first number is the lightness."""
    part = np.array([int(colour[at:at + 2], 16) for at in (1, 3, 5)]) / 255.0
    linear = np.where(part <= 0.04045, part / 12.92, ((part + 0.055) / 1.055)**2.4)
    x, y, z = TO_XYZ @ np.clip(SIGHTS[sight] @ linear, 0.0, 1.0) / (TO_XYZ @ np.ones(3))
    x, y, z = (np.cbrt(value) if value > (6.0 / 29.0)**3 else value * (29.0 / 6.0)**2 / 3.0 + 4.0 / 29.0
               for value in (x, y, z))
    return np.array([116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)])


def distance(sight, one, other):
    return float(np.linalg.norm(colour_in(sight, one) - colour_in(sight, other)))


def in_grey(one, other):
    return float(abs(colour_in("normal", one)[0] - colour_in("normal", other)[0]))


class Palette(unittest.TestCase):
    LISTS = {"classes": [*PALETTE["classes"], PALETTE["no_contact"], *PALETTE["no_motion"]],
             "findings": list(statement_map.LOOKS.values())}

    def pairs(self):
        """Entries of one list that hatching does not tell apart."""
        found = [(one, other) for entries in self.LISTS.values() for one, other in itertools.combinations(entries, 2)
                 if one.get("hatch") == other.get("hatch")]
        self.assertGreaterEqual(len(found), 15)
        return found

    def test_entries_without_hatchings_of_their_own_differ_for_every_sight(self):
        for sight, (one, other) in itertools.product(SIGHTS, self.pairs()):
            with self.subTest(sight=sight, one=one["name"], other=other["name"]):
                self.assertGreater(distance(sight, one["colour"], other["colour"]), LEAST_DISTANCE)

    def test_entries_without_hatchings_of_their_own_differ_in_greyscale(self):
        for one, other in self.pairs():
            with self.subTest(one=one["name"], other=other["name"]):
                self.assertGreater(in_grey(one["colour"], other["colour"]), LEAST_LIGHTNESS)

    def test_what_is_no_motion_or_an_unresolved_one_has_a_hatching_of_its_own(self):
        hatched = [entry["hatch"] for entry in self.LISTS["classes"] if "hatch" in entry]
        self.assertEqual(len(set(hatched)), len(hatched))
        plain = {entry["name"] for entry in self.LISTS["classes"] if "hatch" not in entry}
        self.assertEqual(plain, {"period 1", "period 2", "period 3", "period 4", "period 5 to 16", "aperiodic"})

    def test_the_check_finds_colours_that_are_alike(self):
        self.assertLess(distance("deuteranopia", "#CC79A7", "#a0a0a0"), LEAST_DISTANCE)
        self.assertLess(in_grey("#c6e2f5", "#f3d9cd"), LEAST_LIGHTNESS)
        self.assertLess(distance("protanopia", "#ff0000", "#5a5000"), LEAST_DISTANCE)
        self.assertAlmostEqual(colour_in("normal", "#ffffff")[0], 100.0)
        for sight in SIGHTS:  # grey is grey to everybody
            np.testing.assert_allclose(colour_in(sight, "#808080"), colour_in("normal", "#808080"), atol=0.02)

    def test_the_page_takes_its_classes_from_the_same_data(self):
        with tempfile.TemporaryDirectory() as folder:
            report = pathlib.Path(folder) / "report.html"
            ended = ended_command("rubatlas-report", TINY / "atlas.h5", "-o", report, "--without-solver", "--orbits",
                                  "0")
            self.assertEqual(ended.returncode, 0, ended.stderr)
            page = report.read_text()
        found = re.search(r'<script type="application/json" id="palette">(.*?)</script>', page, re.S)
        self.assertEqual(json.loads(found[1]), PALETTE)
        for source in (ROOT / "tools/rubatlas/report/page").iterdir():
            for entry in self.LISTS["classes"]:
                if entry["colour"] != "#ffffff":
                    self.assertNotIn(entry["colour"], source.read_text())


if __name__ == "__main__":
    unittest.main()

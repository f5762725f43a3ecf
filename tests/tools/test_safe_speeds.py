"""Bands of safe speeds: what the tool says is what the atlas holds."""
import json
import os
import pathlib
import sys
import tempfile
import unittest

import h5py
import numpy as np

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
TINY = pathlib.Path(os.environ["RUBATLAS_PROGRAM"]).parent / "tests/tiny_atlas"
sys.path.insert(0, str(ROOT / "tests/support"))
from forked_commands import ended_command  # noqa: E402
DONE = 1


class SafeSpeeds(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_tool(self, *arguments):
        return ended_command("rubatlas-plot", "safe_speeds", TINY / "atlas.h5", "-o", self.folder / "safe.png",
                             *arguments)

    def bands(self, *arguments):
        ended = self.run_tool("--json", self.folder / "safe.json", *arguments)
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        self.assertTrue((self.folder / "safe.png").read_bytes().startswith(b"\x89PNG"))
        return json.loads((self.folder / "safe.json").read_text()), ended.stdout

    def speeds_in(self, result):
        with h5py.File(TINY / "atlas.h5") as atlas:
            speed = atlas["speed_ratio"][...]
        inside = np.zeros(len(speed), dtype=bool)
        for band in result["bands"]:
            part = (speed >= band["from"]) & (speed <= band["to"])
            self.assertEqual(part.sum(), band["points"])
            inside |= part
        return inside

    def test_bands_are_the_speeds_at_which_every_line_keeps_every_limit(self):
        result, _ = self.bands("--keep", "max_displacement<=0.008", "--keep", "max_contact_force<=200")
        with h5py.File(TINY / "atlas.h5") as atlas:
            kept = (atlas["status"][...] == DONE) & (atlas["max_displacement"][...] <=
                                                     0.008) & (atlas["max_contact_force"][...] <= 200)
        safe = kept.reshape(-1, kept.shape[-1]).all(axis=0)
        self.assertTrue(0 < safe.sum() < len(safe))
        np.testing.assert_array_equal(self.speeds_in(result), safe)

    def test_a_named_value_leaves_out_the_other_lines(self):
        result, _ = self.bands("--keep", "max_displacement<=0.008", "--damping_ratio", "0.2")
        with h5py.File(TINY / "atlas.h5") as atlas:
            line = (0, 0, 0, 2)
            safe = (atlas["status"][line] == DONE) & (atlas["max_displacement"][line] <= 0.008)
        self.assertEqual(result["lines"], 1)
        np.testing.assert_array_equal(self.speeds_in(result), safe)

    def test_the_margin_is_the_percentage_of_speed_to_either_end(self):
        result, text = self.bands("--keep", "max_displacement<=0.008", "--damping_ratio", "0.1")
        band = result["bands"][0]
        again, _ = self.bands("--keep", "max_displacement<=0.008", "--damping_ratio", "0.1", "--operate",
                              band["middle"])
        self.assertAlmostEqual(again["operate"]["below_percent"], band["margin_percent"], places=9)
        self.assertAlmostEqual(again["operate"]["above_percent"], band["margin_percent"], places=9)
        self.assertIn(f"±{band['margin_percent']:.1f} %", text)
        self.assertEqual(band["above"]["broken"], ["max_displacement ≤ 0.008"])
        self.assertTrue(band["below"]["open"], "the grid begins there")

    def test_limits_on_margin_and_class_are_those_of_the_maps(self):
        result, _ = self.bands("--maps", TINY / "maps.h5", "--keep", "class<=1", "--keep", "margin>=0.03",
                               "--damping_ratio", "0.1")
        with h5py.File(TINY / "maps.h5") as maps:
            line = (0, 0, 0, 1)
            margin = maps["margins/speed_ratio"][line]
            safe = (maps["class"][line] <= 1) & (maps["class"][line] > 0) & ~(margin < 0.03)
        self.assertGreater(safe.sum(), 0)
        np.testing.assert_array_equal(self.speeds_in(result), safe)

    def test_a_miss_that_does_not_occur_keeps_its_limit(self):
        result, _ = self.bands("--keep", "nearest_miss>=1e9")
        with h5py.File(TINY / "atlas.h5") as atlas:
            safe = ((atlas["status"][...] == DONE) & np.isnan(atlas["nearest_miss"][...])).reshape(3, -1).all(axis=0)
        np.testing.assert_array_equal(self.speeds_in(result), safe)

    def test_the_same_bands_are_written_again_and_nothing_else_is_replaced(self):
        first, _ = self.bands("--keep", "max_displacement<=0.008")
        self.assertEqual(first, self.bands("--keep", "max_displacement<=0.008")[0])
        (self.folder / "safe.json").write_text('{"grid": 1}')
        ended = self.run_tool("--keep", "max_displacement<=0.008", "--json", self.folder / "safe.json")
        self.assertEqual(ended.returncode, 2)
        self.assertEqual((self.folder / "safe.json").read_text(), '{"grid": 1}')

    def test_a_mistake_is_one_sentence_and_exit_code_2(self):
        for arguments, words in ((["--keep", "max_displacement<0.008"], "not of the form"),
                                 (["--keep", "max_displacement<=wide"], "not of the form"),
                                 (["--keep", "displacement<=1"], "not in this file"),
                                 (["--keep", "poincare<=1"], "more than one number per point"),
                                 (["--keep", "class<=1"], "--maps"),
                                 (["--keep", "max_displacement<=1", "--operate", "3"], "outside the atlas"),
                                 (["--keep", "max_displacement<=1", "--json", "/nowhere/safe.json"], "folder")):
            ended = self.run_tool(*arguments)
            self.assertEqual((ended.returncode, ended.stderr.count("\n")), (2, 1), ended.stderr)
            self.assertIn(words, ended.stderr)


if __name__ == "__main__":
    unittest.main()

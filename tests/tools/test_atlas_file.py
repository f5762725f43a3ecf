"""Reading an atlas: lines by their parameters, rows through their status, and answers to what is not there."""
import os
import pathlib
import shutil
import sys
import tempfile
import unittest

import h5py
import numpy as np

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
TINY = pathlib.Path(os.environ["RUBATLAS_PROGRAM"]).parent / "tests/tiny_atlas"
sys.path.insert(0, str(ROOT / "tools"))
from atlas_file import AtlasError, AtlasFile  # noqa: E402


class ToolsAtlasFile(unittest.TestCase):
    def test_a_line_is_picked_by_its_values(self):
        with AtlasFile(TINY / "atlas.h5") as atlas, h5py.File(TINY / "atlas.h5") as file:
            line = atlas.line(damping_ratio=0.2)
            np.testing.assert_array_equal(line.rows("max_displacement"), file["max_displacement"][0, 0, 0, 2])
            self.assertIn("damping ratio 0.2", line.describe())

    def test_what_is_not_named_has_the_scenes_own_value(self):
        with AtlasFile(TINY / "atlas.h5") as atlas:
            self.assertEqual(atlas.line().value("damping_ratio"), 0.1)

    def test_a_quantity_swept_by_its_pointer_is_the_lines_own(self):
        with AtlasFile(TINY / "rings.h5") as atlas:
            self.assertEqual(atlas.axes[0], "ring_radius")
            for radius in (0.109, 0.11):
                line = atlas.line(ring_radius=radius)
                self.assertEqual(line.scene["ring"]["radius"], radius)
                self.assertAlmostEqual(line.clearance, radius - 0.1, places=15)

    def test_a_value_that_is_not_there_is_answered_with_those_that_are(self):
        with AtlasFile(TINY / "atlas.h5") as atlas:
            with self.assertRaisesRegex(AtlasError, "damping_ratio 0.3 is not in this atlas, which has 0.05, 0.1, 0.2"):
                atlas.line(damping_ratio=0.3)

    def test_an_axis_that_is_not_there_is_answered_with_those_that_are(self):
        with AtlasFile(TINY / "atlas.h5") as atlas:
            with self.assertRaisesRegex(AtlasError, "no axis dampng.*thickness, unbalance, friction, damping_ratio"):
                atlas.line(dampng=0.3)

    def test_rows_that_are_not_done_hold_no_numbers(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "atlas.h5"
            shutil.copy(TINY / "atlas.h5", path)
            with h5py.File(path, "r+") as file:
                file["status"][0, 0, 0, 1, 3] = 0  # pending, though numbers stand in its rows
                file["status"][0, 0, 0, 1, 5] = 2
            with AtlasFile(path) as atlas:
                rows = atlas.line().rows("max_displacement")
                self.assertEqual(np.flatnonzero(np.isnan(rows)).tolist(), [3, 5])
                self.assertTrue(np.isnan(atlas.line().rows("poincare")[3]).all())

    def test_a_missing_observable_is_answered_with_those_that_are_there(self):
        with AtlasFile(TINY / "atlas.h5") as atlas:
            with self.assertRaisesRegex(AtlasError, "/wear is not in this file, which has .*max_displacement"):
                atlas.line().rows("wear")

    def test_a_file_that_is_no_atlas_is_said_to_be_none(self):
        with self.assertRaisesRegex(AtlasError, "not a readable HDF5 file"):
            AtlasFile(__file__)

    def test_the_clearance_is_that_of_the_scene(self):
        with AtlasFile(TINY / "atlas.h5") as atlas:
            self.assertAlmostEqual(atlas.clearance, 0.01, delta=1e-15)


if __name__ == "__main__":
    unittest.main()

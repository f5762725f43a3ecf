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
from rubatlas.atlas_file import AtlasError, AtlasFile, counted  # noqa: E402


class ToolsAtlasFile(unittest.TestCase):
    def test_one_thing_is_counted_as_one(self):
        self.assertEqual([counted(number, "points") for number in (0, 1, 2)], ["0 points", "1 point", "2 points"])

    def test_a_line_is_picked_by_its_values(self):
        with AtlasFile(TINY / "atlas.h5") as atlas, h5py.File(TINY / "atlas.h5") as file:
            line = atlas.line(damping_ratio=0.2)
            np.testing.assert_array_equal(line.rows("max_displacement"), file["max_displacement"][0, 0, 0, 2])
            self.assertIn("damping ratio 0.2", line.describe())

    def test_what_is_not_named_has_the_scenes_own_value(self):
        with AtlasFile(TINY / "atlas.h5") as atlas:
            self.assertEqual(atlas.line().value("damping_ratio"), 0.1)
        with AtlasFile(TINY / "rings.h5") as atlas:
            self.assertEqual(atlas.line().value("ring_radius"), 0.11)  # not the first of the grid

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

    def refusal(self, change, name="atlas.h5"):
        """What is said of a copy that `change` has had open."""
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "bad.h5"
            shutil.copy(TINY / name, path)
            with h5py.File(path, "r+") as file:
                change(file)
            with self.assertRaises(AtlasError) as caught:
                AtlasFile(path)
            self.assertTrue(str(caught.exception).startswith(f"{path}: "))
            return str(caught.exception).removeprefix(f"{path}: ")

    def test_a_dataset_that_does_not_lie_on_the_axes_is_refused_when_the_file_is_opened(self):
        def replace(name, **kind):
            def change(file):
                del file[name]
                file.create_dataset(name, **kind)
            return change

        def external(file):
            del file["poincare"]
            file["poincare"] = h5py.ExternalLink("elsewhere.h5", "/poincare")

        def set_to(name, value):
            def change(file):
                file[name][0, 0, 0, 1, 3] = value
            return change

        cases = [(replace("status", data=np.uint8(1)), "/status is one number"),
                 (replace("status", data=b"text"), "/status is one number"),
                 (set_to("status", 4), "/status has a 4, and no status is above 3"),
                 (lambda file: file["status"].dims[3].detach_scale(file["damping_ratio"]),
                  "axis 3 of /status has no scale"),
                 (replace("poincare", data=b"a text"), "/poincare does not hold the numbers"),
                 (replace("poincare", data=np.zeros((2, 2))), "/poincare has the shape"),
                 (lambda file: file.__delitem__("poincare"), "/poincare is missing"),
                 (external, "/poincare is no dataset of this file"),
                 (set_to("final_state", np.nan), "/final_state of a point that is done is not finite"),
                 (replace("speed_ratio", data=np.zeros(3)), "/status"),
                 (replace("scene_resolved", data=b"{}"), "/scene_resolved is not a scene"),
                 (replace("scene_resolved", data=b"no JSON"), "/scene_resolved is not a scene")]
        for number, (change, sentence) in enumerate(cases):
            with self.subTest(number=number):
                self.assertIn(sentence, self.refusal(change))

    def test_maps_that_do_not_lie_on_their_axes_are_refused(self):
        def change(file):
            file["class"].dims[4].detach_scale(file["speed_ratio"])
        self.assertIn("axis 4 of /class has no scale", self.refusal(change, "maps.h5"))

    def test_a_title_has_no_control_characters(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "atlas.h5"
            shutil.copy(TINY / "atlas.h5", path)
            with h5py.File(path, "r+") as file:
                file.attrs["title"] = "red \x1b[31m bell \x07 end"
            with AtlasFile(path) as atlas:
                self.assertEqual(atlas.attribute("title"), "red [31m bell  end")

    def test_the_clearance_is_that_of_the_scene(self):
        with AtlasFile(TINY / "atlas.h5") as atlas:
            self.assertAlmostEqual(atlas.line().clearance, 0.01, delta=1e-15)


if __name__ == "__main__":
    unittest.main()

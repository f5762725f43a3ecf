"""The kick of a grazing contact, by experiment with the program, against what the contact laws say (MODEL 4.2)."""
import os
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
PROGRAM = pathlib.Path(os.environ["RUBATLAS_PROGRAM"])
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tests/support")]
from forked_commands import ended_command  # noqa: E402
from rubatlas.plots import grazing  # noqa: E402


class GrazingKick(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kicks = grazing.measure(PROGRAM)

    def test_grows_with_the_depth_as_the_side_of_the_contact_says(self):
        kicks = self.kicks
        for law, side, exponent in (("elastica", "approaching", 1.5), ("elastica", "receding", 0.5),
                                    ("elastic_ring", "approaching", 1.5),
                                    ("elastic_ring", "head-on", 1.5), ("elastic_ring", "receding", 1.5)):
            self.assertAlmostEqual(grazing.slopes(kicks[law, side])[-1], exponent, delta=1e-3)
        # Head-on the force is the larger part of the tip's acceleration down to depths of a nanometre, and the
        # slope comes to 1 with the root of the depth.
        short_of_one = 1.0 - grazing.slopes(kicks["elastica", "head-on"])
        self.assertTrue((short_of_one > 0.0).all() and short_of_one[-1] < 0.02)
        self.assertAlmostEqual(short_of_one[-3] / short_of_one[-1], 10**0.5, delta=0.8)

    def test_a_file_that_is_no_program_is_refused_and_not_run(self):
        with tempfile.TemporaryDirectory() as folder:
            atlas = pathlib.Path(folder) / "atlas.h5"
            atlas.write_bytes(b"")
            ended = ended_command("rubatlas-plot", "grazing", atlas, "-o", pathlib.Path(folder) / "grazing.png")
        self.assertEqual(ended.returncode, 2)
        self.assertIn("atlas.h5: no program; the first argument is the program rubatlas", ended.stderr)

    def test_the_experiment_is_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "grazing.png"
            with mock.patch.object(grazing, "measure", lambda program: self.kicks):
                ended = ended_command("rubatlas-plot", "grazing", PROGRAM, "-o", path, "--table")
            self.assertEqual((ended.returncode, ended.stderr), (0, ""))
            self.assertIn("| `elastica`", ended.stdout)
            self.assertTrue(path.read_bytes().startswith(b"\x89PNG"))

    def test_another_file_in_place_of_the_program_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            ended = ended_command("rubatlas-plot", "grazing", pathlib.Path(folder) / "none", "-o",
                                  pathlib.Path(folder) / "a.png")
            self.assertEqual((ended.returncode, ended.stderr.count("\n")), (2, 1))


if __name__ == "__main__":
    unittest.main()

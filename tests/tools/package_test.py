"""What tests of the package share: where its files lie, a small scene, a folder of their own."""
import os
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
TINY = pathlib.Path(os.environ["RUBATLAS_PROGRAM"]).parent / "tests/tiny_atlas"
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tests/support")]
import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

TWO_POINTS = {"title": "Two points", "grid": {"speed_ratio": [0.3, 0.4]},
              "protocol": {"transient_revolutions": 5, "sampled_revolutions": 4}}


class WithFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.addCleanup(plt.close, "all")

"""What tests of pictures share: their atlas, and a look at what is drawn."""
import contextlib
import importlib
import io
import os
import pathlib
import tempfile
import unittest
import unittest.mock

import numpy as np
from forked_commands import ended_command
from rubatlas import style

TINY = pathlib.Path(os.environ["RUBATLAS_PROGRAM"]).parent / "tests/tiny_atlas"


def run(tool, *arguments):
    """Runs a tool as its user does."""
    return ended_command("rubatlas-plot", tool, *arguments)


def unplaced():
    """Within it panels stand where they are made, for tests that do not ask where: to place them takes longer than to
    draw them, and `test_picture_layout.py` has every kind placed."""
    return unittest.mock.patch.object(style, "_place", lambda made: None)


class Figure:
    """A picture caught just before it is written, to look at what it holds."""

    def __init__(self, tool, *arguments):
        module = importlib.import_module(f"rubatlas.plots.{tool}")
        caught = []
        with unittest.mock.patch.object(style, "save", lambda figure, options: caught.append(figure)), \
                contextlib.redirect_stdout(io.StringIO()):
            module.main([*map(str, arguments), "-o", "none.png"])
        self.figure = caught[0]
        self.figure.set_layout_engine("none")  # its panels are placed in other tests; it takes longer than to draw
        style.plt.close(self.figure)  # pyplot forgets it

    def texts(self):
        parts = [self.figure._suptitle.get_text(), self.figure._supxlabel.get_text()]
        for axes in self.figure.axes:
            parts += [axes.get_title(loc="left"), axes.get_xlabel(), axes.get_ylabel()]
            parts += [text.get_text() for text in (axes.get_legend().get_texts() if axes.get_legend() else [])]
        return "\n".join(parts)


class PicturesCase(unittest.TestCase):
    def expect_picture(self, tool, *arguments, colours=20):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "picture.png"
            with unplaced():
                ended = run(tool, *arguments, "-o", path)
            self.assertEqual((ended.returncode, ended.stderr), (0, ""))
            self.assertEqual(ended.stdout.strip(), str(path))
            self.expect_drawn(path, colours)

    def expect_drawn(self, path, colours=20):
        pixels = (255 * style.plt.imread(path)[:, :, :3]).round().astype(np.uint32)
        height, width = pixels.shape[:2]
        self.assertTrue(500 <= width <= 2400 and 400 <= height <= 2400, f"{width} x {height} pixels")
        coded = pixels @ np.array([65536, 256, 1], dtype=np.uint32)
        ink = np.mean(coded != 0xFFFFFF)
        self.assertTrue(0.01 < ink < 0.95, f"{ink:.3f} of the picture is not white")
        self.assertGreater(len(np.unique(coded)), colours)

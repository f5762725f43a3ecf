"""Every picture: it is drawn by its command, holds what the atlas holds, and is labelled from the file."""
import importlib
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
TINY = pathlib.Path(os.environ["RUBATLAS_PROGRAM"]).parent / "tests/tiny_atlas"
sys.path.insert(0, str(ROOT / "tools"))
import command_line  # noqa: E402
import style  # noqa: E402
from atlas_file import AtlasFile  # noqa: E402


def run(tool, *arguments):
    """Runs a tool as its user does."""
    return subprocess.run([ROOT / "tools" / tool, *map(str, arguments)], capture_output=True, text=True, check=False)


class Figure:
    """A picture caught just before it is written, to look at what it holds."""

    def __init__(self, tool, *arguments):
        module = importlib.import_module(tool)
        caught = []
        keep, style.save = style.save, lambda figure, options: caught.append(figure)
        try:
            parser = command_line.parser(module.__doc__)
            for option in ("--maps", "--along"):
                parser.add_argument(option)
            parser.add_argument("--passing", action="store_true")
            parser.add_argument("--max_frequency", type=float)
            parser.add_argument("--revolutions", type=int, default=3)
            module.draw(parser.parse_args([*map(str, arguments), "-o", "none.png"]))
        finally:
            style.save = keep
        self.figure = caught[0]

    def texts(self):
        parts = [self.figure._suptitle.get_text(), self.figure._supxlabel.get_text()]
        for axes in self.figure.axes:
            parts += [axes.get_title(loc="left"), axes.get_xlabel(), axes.get_ylabel()]
            parts += [text.get_text() for text in (axes.get_legend().get_texts() if axes.get_legend() else [])]
        return "\n".join(parts)


class ToolsPictures(unittest.TestCase):
    def expect_picture(self, tool, *arguments, colours=20):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "picture.png"
            ended = run(tool, *arguments, "-o", path)
            self.assertEqual((ended.returncode, ended.stderr), (0, ""))
            self.assertEqual(ended.stdout.strip(), str(path))
            pixels = (255 * style.plt.imread(path)[:, :, :3]).round().astype(np.uint32)
        height, width = pixels.shape[:2]
        self.assertTrue(500 <= width <= 2400 and 400 <= height <= 2400, f"{width} x {height} pixels")
        coded = pixels @ np.array([65536, 256, 1], dtype=np.uint32)
        ink = np.mean(coded != 0xFFFFFF)
        self.assertTrue(0.01 < ink < 0.95, f"{ink:.3f} of the picture is not white")
        self.assertGreater(len(np.unique(coded)), colours)

    def test_the_bifurcation_diagram_is_drawn(self):
        self.expect_picture("bifurcation.py", TINY / "atlas.h5")

    def test_the_bifurcation_diagram_is_drawn_per_blade_passing(self):
        self.expect_picture("bifurcation.py", TINY / "atlas.h5", "--passing")

    def test_the_waterfall_is_drawn(self):
        self.expect_picture("waterfall.py", TINY / "atlas.h5", "--damping_ratio", 0.05, colours=100)

    def test_the_displacement_is_drawn(self):
        self.expect_picture("displacement.py", TINY / "atlas.h5")

    def test_the_sensitivity_map_is_drawn(self):
        self.expect_picture("sensitivity.py", TINY / "atlas.h5", "--maps", TINY / "maps.h5", colours=50)

    def test_the_orbit_is_drawn(self):
        self.expect_picture("orbit.py", TINY / "orbit.h5")

    def test_the_blade_is_drawn(self):
        self.expect_picture("blade.py", TINY / "atlas.h5")

    def test_an_effect_is_drawn_beside_its_absence(self):
        self.expect_picture("effect.py", TINY / "atlas.h5", "--without", TINY / "atlas.h5", "--dpi", 100)

    def test_the_map_of_statements_is_drawn(self):
        self.expect_picture("statement_map.py", TINY / "maps.h5", TINY / "rings_maps.h5", colours=10)

    def test_every_picture_has_its_command(self):
        tools = sorted(path.name for path in (ROOT / "tools").glob("*.py") if os.access(path, os.X_OK))
        drawn = (ROOT / "tools" / "draw.sh").read_text() + (ROOT / "tools" / "README.md").read_text()
        self.assertGreaterEqual(len(tools), 6)
        for tool in tools:
            self.assertIn(tool, drawn)

    def test_all_pictures_of_an_atlas_are_drawn_at_once(self):
        with tempfile.TemporaryDirectory() as folder:
            ended = run("draw.sh", TINY / "atlas.h5", TINY / "maps.h5", folder)
            self.assertEqual((ended.returncode, ended.stderr), (0, ""))
            names = sorted(path.stem for path in pathlib.Path(folder).glob("*.png"))
        self.assertEqual(names, ["bifurcation", "blade", "displacement", "sensitivity", "sensitivity_blade_passing", "waterfall"])

    def test_all_pictures_are_drawn_where_a_quantity_is_swept_by_its_pointer(self):
        with tempfile.TemporaryDirectory() as folder:
            ended = run("draw.sh", TINY / "rings.h5", TINY / "rings_maps.h5", folder)
            self.assertEqual((ended.returncode, ended.stderr), (0, ""))
            names = sorted(path.stem for path in pathlib.Path(folder).glob("*.png"))
        self.assertEqual(names, ["bifurcation", "blade", "displacement", "sensitivity", "waterfall"])
        self.assertIn("Ring radius [mm]", Figure("sensitivity", TINY / "rings.h5").texts())
        self.assertIn("ring radius 0.11 m", Figure("bifurcation", TINY / "rings.h5", "--at", "ring_radius=0.11").texts())

    def test_a_displacement_is_drawn_over_the_clearance_of_its_own_line(self):
        figure = Figure("displacement", TINY / "rings.h5", "--damping_ratio", 0.1)
        self.assertIn("clearance 9 to 10 mm", figure.texts())
        with AtlasFile(TINY / "rings.h5") as atlas:
            for curve, radius in zip(figure.figure.axes[0].lines, (0.109, 0.11)):
                displacement = atlas.line(ring_radius=radius, damping_ratio=0.1).rows("max_displacement")
                np.testing.assert_allclose(curve.get_ydata(), displacement / (radius - 0.1), rtol=1e-12)

    def test_an_orbit_is_drawn_in_its_own_ring(self):
        self.assertIn("clearance 9.5 mm", Figure("orbit", TINY / "rings_orbit.h5").texts())
        self.assertIn("ring radius 0.1095", Figure("orbit", TINY / "rings_orbit.h5").texts())

    def test_the_same_atlas_gives_the_same_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            pictures = [pathlib.Path(folder) / name for name in ("a.png", "b.png")]
            for picture in pictures:
                run("displacement.py", TINY / "atlas.h5", "-o", picture)
            self.assertEqual(pictures[0].read_bytes(), pictures[1].read_bytes())

    def test_the_title_says_which_line_is_drawn(self):
        texts = Figure("bifurcation", TINY / "atlas.h5", "--damping_ratio", 0.2).texts()
        self.assertIn("Tiny atlas", texts)
        self.assertIn("damping ratio 0.2", texts)
        self.assertIn("made by the tests", texts)

    def test_axes_carry_the_names_and_units_of_the_file(self):
        texts = Figure("bifurcation", TINY / "atlas.h5").texts()
        self.assertIn("Speed ratio Ω [-]", texts)
        self.assertIn("max. displacement [mm]", texts)
        self.assertIn("Damping ratio ζ [-]", Figure("sensitivity", TINY / "atlas.h5").texts())

    def test_the_dots_are_the_sections_of_the_atlas(self):
        figure = Figure("bifurcation", TINY / "atlas.h5", "--damping_ratio", 0.1).figure
        with AtlasFile(TINY / "atlas.h5") as atlas:
            sections = atlas.line(damping_ratio=0.1).rows("poincare")
        for panel, component in zip(figure.axes, (0, 1)):
            drawn = panel.lines[0].get_ydata()
            np.testing.assert_array_equal(drawn, 1e3 * sections[:, :, component].ravel())

    def test_the_map_has_one_row_per_value_of_the_parameter(self):
        figure = Figure("sensitivity", TINY / "atlas.h5", "--maps", TINY / "maps.h5").figure
        image = figure.axes[0].images[0].get_array()
        with AtlasFile(TINY / "atlas.h5") as atlas:
            wanted = [1e3 * atlas.line(damping_ratio=value).rows("max_displacement") for value in (0.05, 0.1, 0.2)]
        largest = np.nanmax(wanted)  # the map covers three decades below it
        np.testing.assert_array_equal(np.ma.filled(image, np.nan), np.maximum(wanted, 1e-3 * largest))

    def test_points_without_a_motion_are_covered_and_said_to_be_so(self):
        figure = Figure("sensitivity", TINY / "atlas.h5", "--maps", TINY / "maps.h5")
        with AtlasFile(TINY / "atlas.h5") as atlas:
            missing = np.array([line.status() for line in atlas.lines("damping_ratio")]) == 2
        self.assertTrue(missing.any() and not missing.all())
        np.testing.assert_array_equal(figure.figure.axes[0].images[1].get_array()[:, :, 3] > 0, missing)
        self.assertIn("left the model's validity", figure.texts())

    def test_the_waterfall_puts_a_line_at_its_order_times_the_speed(self):
        waterfall = importlib.import_module("waterfall")
        order, speed = np.arange(0, 121) / 10.0, np.array([0.2, 0.5])
        amplitude = np.zeros((2, 121))
        amplitude[:, 30] = 1.0  # order 3
        edges = np.linspace(0.0, 4.0, 401)
        shown = waterfall.by_frequency(speed, order, amplitude, edges)
        middle = 0.5 * (edges[1:] + edges[:-1])
        for row, ratio in zip(shown, speed):
            lit = middle[row == 1.0]
            self.assertTrue(len(lit) and np.all(np.abs(lit - 3.0 * ratio) <= 0.5 * 0.1 * ratio + 0.01), lit)

    def test_the_waterfall_keeps_the_height_of_a_narrow_line(self):
        waterfall = importlib.import_module("waterfall")
        order, amplitude = np.arange(0, 1201) / 100.0, np.full((1, 1201), 1e-6)
        amplitude[0, 100] = 0.7
        shown = waterfall.by_frequency(np.array([0.5]), order, amplitude, np.linspace(0.0, 4.0, 41))
        self.assertEqual(shown.max(), 0.7)

    def test_a_mistake_is_one_sentence_and_exit_code_2(self):
        ended = run("bifurcation.py", TINY / "atlas.h5", "-o", "none.png", "--damping_ratio", "0.7")
        self.assertEqual(ended.returncode, 2)
        self.assertRegex(ended.stderr, r"^bifurcation.py: .*damping_ratio 0.7 is not in this atlas, which has 0.05, 0.1, 0.2\n$")


if __name__ == "__main__":
    unittest.main()

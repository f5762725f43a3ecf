"""How pictures are laid out: in a column of a journal every word is read, no title is cut, small orbits are seen."""
import contextlib
import importlib
import io
import itertools
import os
import pathlib
import subprocess
import sys
import tempfile
import textwrap
import unittest
import unittest.mock

import numpy as np

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
PROGRAM = pathlib.Path(os.environ["RUBATLAS_PROGRAM"])
TINY = PROGRAM.parent / "tests/tiny_atlas"
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tests/support")]
import matplotlib  # noqa: E402

matplotlib.use("Agg")
import rubatlas  # noqa: E402
from forked_commands import ended_command  # noqa: E402
from rubatlas import command_line  # noqa: E402
from rubatlas import style  # noqa: E402
from rubatlas.plots import KINDS  # noqa: E402

COLUMN = 85.0 / 25.4  # [inch]
SMALLEST_LETTERS = 6.0  # [pt] that print shows well; journals ask for 5 to 7
LONG = "A rotor whose owner has a lot to say about it, " * 4
# Each kind with files of `TINY`, and what else it needs.
CALLS = {
    "bifurcation": ("atlas.h5", "--damping_ratio", "0.05"), "waterfall": ("atlas.h5",), "displacement": ("atlas.h5",),
    "map": ("atlas.h5", "--maps", "maps.h5"), "margin": ("atlas.h5", "--maps", "maps.h5"),
    "signature": ("atlas.h5", "--maps", "maps.h5"),
    "spectrum": ("atlas.h5", "--speed_ratio", "0.6"), "orbit": ("orbit.h5",), "blade": ("atlas.h5",),
    "safe_speeds": ("atlas.h5", "--keep", "max_displacement<=0.008", "--keep", "max_contact_force<=200"),
    "basins": ("basins.h5", "--maps", "basins_maps.h5"), "branch": ("branch.h5",),
    "effect": ("gravity.h5", "--without", "atlas.h5", "--damping_ratio", "0.05"), "grazing": (str(PROGRAM),),
    "stack": ("atlas.h5", "--maps", "maps.h5"), "accuracy": ("accuracy.h5",)}


def touches_nothing(folder):
    """An atlas of a centred rotor, which touches its ring at none but the largest unbalance and the highest speeds."""
    scene = {"title": "A gap", "rotor": {"misalignment": 0.0},
             "grid": {"speed_ratio": {"from": 0.6, "to": 1.2, "count": 13}, "unbalance": [1e-3, 5e-3]},
             "protocol": {"transient_revolutions": 60, "sampled_revolutions": 8, "samples_per_revolution": 64},
             "observables": ["poincare", "max_displacement", "contact_fraction"]}
    return rubatlas.run(scene, folder / "gap.h5")


def titled(words):
    """Pictures have this title."""
    headline = style.headline
    return unittest.mock.patch.object(style, "headline", lambda figure, _: headline(figure, words))


class LayoutTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        subprocess.run([PROGRAM, "branch", ROOT / "jobs/default.json", "--from", "speed_ratio=0.62", "--along",
                        "speed_ratio", "--to", "0.70", "--points", "80", "-o", cls.folder / "branch.h5"], check=True,
                       capture_output=True)

    def drawn(self, kind, look, *options):
        """Draws a kind as its command does, and looks at each picture before it is written."""
        words = [next((str(place / word) for place in (TINY, self.folder) if (place / word).is_file()), word)
                 for word in CALLS[kind]]
        module = importlib.import_module(f"rubatlas.plots.{kind}")
        output = self.folder if kind == "accuracy" else self.folder / "none.png"
        seen = []
        kicks = {(law, side): np.logspace(-4, -10, 13) for law in ("elastica", "elastic_ring")
                 for side in ("approaching", "head-on", "receding")}
        with contextlib.ExitStack() as stack:
            stack.enter_context(unittest.mock.patch.object(
                command_line, "write_picture", lambda figure, _: seen.append(look(figure))))
            stack.enter_context(contextlib.redirect_stdout(io.StringIO()))
            if kind == "grazing":  # its experiment is another test's
                stack.enter_context(unittest.mock.patch.object(module, "measure", lambda _: kicks))
            module.main([*words, "-o", str(output), *options])
        self.assertTrue(seen)

    def expect_inside(self, figure):
        """Nothing of the picture is cut."""
        box, size = figure.get_tightbbox(figure.canvas.get_renderer()), figure.get_size_inches()
        for low, high, most in ((box.x0, box.x1, size[0]), (box.y0, box.y1, size[1])):
            self.assertGreater(low, -0.03)
            self.assertLess(high, most + 0.03)

    def expect_apart(self, *boxes):
        for one, other in itertools.combinations(boxes, 2):
            wide, tall = (min(one.max[i], other.max[i]) - max(one.min[i], other.min[i]) for i in (0, 1))
            self.assertFalse(wide > 1.0 and tall > 1.0, f"{one} covers {other}")

    def expect_legible(self, figure):
        """Letters are large enough; legends, titles and labels do not cover each other, nor legends the data."""
        self.expect_inside(figure)
        renderer = figure.canvas.get_renderer()
        for text in figure.findobj(matplotlib.text.Text):
            if text.get_visible() and text.get_text().strip():
                self.assertGreaterEqual(text.get_fontsize(), SMALLEST_LETTERS, text.get_text())
        shown = [axes for axes in figure.axes if axes.axison]
        legends = [axes.get_legend().get_window_extent(renderer) for axes in figure.axes if axes.get_legend()]
        titles = [text.get_window_extent(renderer)
                  for text in (figure._suptitle, figure._supxlabel, *(axes._left_title for axes in shown))
                  if text is not None and text.get_text()]
        labels = [axis.label.get_window_extent(renderer) for axes in shown for axis in (axes.xaxis, axes.yaxis)
                  if axis.label.get_text()]
        self.expect_apart(*legends, *titles, *labels)
        for legend, axes in itertools.product(legends, shown):
            self.expect_apart(legend, axes.bbox)
            numbers = axes.xaxis.get_tightbbox(renderer)
            self.expect_apart(legend, *([numbers] if numbers is not None else []))

    def expect_column(self, figure):
        self.assertAlmostEqual(figure.get_figwidth(), COLUMN, places=6)
        self.assertLess(figure.get_figheight(), 247.0 / 25.4, "higher than a page")
        self.expect_legible(figure)

    def expect_no_long_title_to_be_cut(self, kinds):
        with titled(LONG):
            for kind in kinds:
                with self.subTest(kind):
                    self.drawn(kind, self.expect_inside)


class Layout(LayoutTest):
    def test_every_kind_is_legible_in_a_column_of_a_journal(self):
        self.assertEqual(set(CALLS), set(KINDS) - {"all"})
        with titled(LONG):
            for kind in CALLS:
                with self.subTest(kind):
                    self.drawn(kind, self.expect_column, "--width", "85mm")

    def test_zooms_and_several_orbits_are_legible_in_a_column_of_a_journal(self):
        zooms = ("atlas.h5", "--maps", "maps.h5", "--damping_ratio", "0.05", "--zoom", "0.3:0.5", "--zoom", "0.6:0.8")
        with unittest.mock.patch.dict(CALLS, {"bifurcation": zooms, "orbit": ("orbit.h5",) * 4}):
            for kind in ("bifurcation", "orbit"):
                with self.subTest(kind):
                    self.drawn(kind, self.expect_column, "--width", "85mm")
                    self.drawn(kind, self.expect_inside)

    def test_no_long_title_is_cut(self):
        # One panel, several of one column or more, a picture that is as high as wide, and one with a colour bar.
        self.expect_no_long_title_to_be_cut(("blade", "displacement", "orbit", "map"))

    def test_no_title_is_cut_where_panels_move_as_it_is_broken(self):
        self.drawn("accuracy", self.expect_column, "--width", "85mm")

    def test_a_title_keeps_its_words_when_its_lines_are_broken(self):
        figure = style.plt.figure(figsize=(3.0, 2.0), layout="constrained")
        figure.subplots()
        style.headline(figure, LONG)
        style.wrap_words(figure)
        self.assertIn("\n", figure._suptitle.get_text())
        self.assertEqual(figure._suptitle.get_text().split(), LONG.split())
        self.assertGreater(figure.get_figheight(), 2.0)

    def test_words_that_are_broken_again_are_broken_as_they_were_given(self):
        text = style.plt.figure(figsize=(3.0, 2.0)).suptitle(LONG)

        def too_wide(room):
            return lambda: max(map(len, text.get_text().split("\n"))) - room
        style._wrap(text, LONG, too_wide(40))
        more = style._wrap(text, LONG, too_wide(30))
        self.assertEqual(text.get_text(), textwrap.fill(LONG, 30))
        self.assertEqual(more, text.get_text().count("\n") - textwrap.fill(LONG, 40).count("\n"))

    def test_a_width_is_a_length_with_its_unit(self):
        with tempfile.TemporaryDirectory() as folder:
            output = pathlib.Path(folder) / "a.png"
            for width in ("85", "85 km", "0mm", "-85mm", "59mm", "nan mm", "1e9mm", "mm"):
                ended = ended_command("rubatlas-plot", "blade", TINY / "atlas.h5", f"--width={width}", "-o", output)
                self.assertEqual(ended.returncode, 2)
                self.assertIn(f"--width: {width} is no width from 60mm to 600mm, in mm, cm or in", ended.stderr)
            for width, pixels in (("60mm", 709), ("85mm", 1004), ("17.4 cm", 2055), ("3.5in", 1050)):
                ended = ended_command("rubatlas-plot", "blade", TINY / "atlas.h5", "--width", width, "-o", output)
                self.assertEqual((ended.returncode, ended.stderr), (0, ""))
                self.assertAlmostEqual(style.plt.imread(output).shape[1], pixels, delta=1)

    def test_a_small_orbit_fills_the_plane_and_its_circle_is_an_inset(self):
        def look(figure):
            plane = figure.axes[0]
            x, y = plane.lines[0].get_data()
            wide = np.ptp(plane.get_xlim())
            self.assertTrue(1.0 < wide / max(np.ptp(x), np.ptp(y)) < 2.0)
            inset, = plane.child_axes
            circle = np.array(inset.lines[0].get_data())
            self.assertAlmostEqual(np.ptp(circle[0]), 20.0)  # mm
            place, = np.transpose(inset.lines[1].get_data())
            np.testing.assert_allclose(place, [np.mean([x.min(), x.max()]), np.mean([y.min(), y.max()])])

        self.drawn("orbit", look)

    def test_an_orbit_that_fills_its_circle_is_drawn_in_it(self):
        def look(figure):
            plane = figure.axes[0]
            self.assertEqual(plane.child_axes, [])
            self.assertGreater(np.ptp(plane.get_xlim()), 20.0)

        with unittest.mock.patch.object(importlib.import_module("rubatlas.plots.orbit"), "SMALL", 0.0):
            self.drawn("orbit", look)

    def test_an_inset_stands_where_the_orbit_is_not(self):
        corner_of = importlib.import_module("rubatlas.plots.orbit").corner_of
        plane = style.plt.figure().subplots()
        plane.set(xlim=(0, 1), ylim=(0, 1))
        corners = {(0.9, 0.9), (0.1, 0.9), (0.9, 0.1), (0.1, 0.1)}
        for free in corners:
            place = corner_of(plane, *np.array([point for point in corners if point != free]).T, 0.3)
            np.testing.assert_allclose(np.add(place, 0.15), np.where(np.array(free) > 0.5, 0.85, 0.15))

    def test_a_branch_says_which_orbits_are_stable_and_what_its_marks_mean(self):
        def look(figure):
            legend = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
            self.assertEqual(legend, ["stable", "unstable", "period doubling"])

        self.drawn("branch", look)

    def test_the_map_of_classes_shows_where_no_blade_touches(self):
        touches_nothing(self.folder)
        atlas = rubatlas.open(self.folder / "gap.h5")
        untouched = atlas["contact_fraction"].values == 0.0
        self.assertTrue(untouched.any() and not untouched.all())

        def look(figure):
            panel = figure.axes[1]
            hatched, = [patch for patch in panel.patches if "." in patch.get_hatch()]
            inside = [[hatched.get_path().contains_point((speed, row)) for speed in atlas["speed_ratio"].values]
                      for row in range(2)]
            np.testing.assert_array_equal(inside, untouched)
            np.testing.assert_array_equal(np.all(panel.images[0].get_array() == 1.0, axis=-1), untouched)
            legend = [text.get_text() for axes in figure.axes if axes.get_legend()
                      for text in axes.get_legend().get_texts()]
            self.assertIn("no blade touches", legend)

        with unittest.mock.patch.dict(CALLS, {"map": ("gap.h5", "--maps", "gap_maps.h5")}):
            self.drawn("map", look)
            self.drawn("map", self.expect_legible, "--width", "85mm")


class LayoutSlow(LayoutTest):
    def test_no_long_title_of_any_kind_is_cut(self):
        self.expect_no_long_title_to_be_cut(CALLS)


if __name__ == "__main__":
    unittest.main()

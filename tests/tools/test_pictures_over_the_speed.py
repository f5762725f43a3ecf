"""Pictures over the speed: sections, displacements, spectra, margins and signs of rubbing."""
import argparse
import importlib
import os
import pathlib
import shutil
import sys
import tempfile
import unittest
import unittest.mock

import h5py
import numpy as np
from matplotlib import pyplot as plt

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tests/support")]
from pictures import TINY, Figure, PicturesCase, run  # noqa: E402
from rubatlas import style  # noqa: E402
from rubatlas.atlas_file import AtlasFile  # noqa: E402
from rubatlas.palette import PALETTE  # noqa: E402
from rubatlas.plots import waterfall  # noqa: E402


class PicturesOverTheSpeed(PicturesCase):
    def test_the_bifurcation_diagram_is_drawn_per_blade_passing(self):
        self.expect_picture("bifurcation", TINY / "atlas.h5", "--passing")

    def test_the_waterfall_is_drawn(self):
        self.expect_picture("waterfall", TINY / "atlas.h5", "--damping_ratio", 0.05, colours=100)

    def test_margins_are_drawn(self):
        self.expect_picture("margin", TINY / "atlas.h5", "--maps", TINY / "maps.h5", colours=50)

    def test_signs_of_rubbing_are_drawn(self):
        self.expect_picture("signature", TINY / "atlas.h5", "--maps", TINY / "maps.h5")

    def test_signs_are_drawn_with_the_limit_and_the_speed_at_which_it_is_passed(self):
        files = TINY / "atlas.h5", "--maps", TINY / "maps.h5"
        panels = Figure("signature", *files, "--damping_ratio", 0.2).figure.axes
        with h5py.File(TINY / "atlas.h5") as atlas, h5py.File(TINY / "maps.h5") as maps:
            displacement, limit = atlas["max_displacement"][0, 0, 0, 2], maps["signature/limit"][2]
            heights = [maps["signs"][name][0, 0, 0, 2] for name in ("passing_line", "broad_band", "subharmonic")]
            passed = maps["signature/limit_speed_ratio"][2]
        for curve, height in zip(panels[0].lines, heights):
            np.testing.assert_allclose(curve.get_ydata(), 1e3 * np.maximum(height, 1e-3 * limit), rtol=1e-12)
        np.testing.assert_array_equal(panels[2].lines[0].get_ydata(), 1e3 * displacement)
        self.assertEqual(panels[2].lines[1].get_ydata(), [1e3 * limit] * 2)
        self.assertEqual(panels[2].lines[-1].get_xdata(), [passed] * 2)

    def test_maps_without_signs_are_answered_with_what_they_need(self):
        ended = run("signature", TINY / "basins.h5", "--maps", TINY / "basins_maps.h5", "-o", "none.png")
        self.assertEqual(ended.returncode, 2)
        self.assertIn("it has no /signature; `rubatlas analyse` writes it for lines from one initial", ended.stderr)

    def test_a_panel_of_signs_that_has_nothing_to_show_says_so(self):
        with tempfile.TemporaryDirectory() as folder:
            atlas, maps = (shutil.copy(TINY / name, folder) for name in ("atlas.h5", "maps.h5"))
            self.assertEqual([len(panel.texts) for panel in Figure("signature", atlas, "--maps", maps).figure.axes],
                             [0, 0, 0])
            with h5py.File(atlas, "r+") as file:
                for name in ("spectrum", "max_displacement"):
                    file[name][...] = 0.0
            with h5py.File(maps) as file:
                least = f"{file['signature/limit'][0]:g} mm"  # a thousandth of it, in metres
            panels = Figure("signature", atlas, "--maps", maps).figure.axes
            self.assertEqual([panel.texts[0].get_text() for panel in panels],
                             [f"below {number} at all speeds" for number in (least, "0.001", least)])

    def test_the_waterfall_marks_the_orders_of_the_blade_passings_beside_the_data(self):
        panel = Figure("waterfall", TINY / "atlas.h5").figure.axes[0]
        names = [text.get_text() for text in panel.texts]
        self.assertEqual(names, ["1×", "2×", "3× = n", "6× = 2n"])
        self.assertTrue(all(len(line.get_xdata()) == 1 for line in panel.lines), "no line runs across the data")
        (right, top), low = (panel.get_xlim()[1], panel.get_ylim()[1]), panel.get_ylim()[0]
        for text, order in zip(panel.texts, (1, 2, 3, 6)):
            frequency, speed = text.xy
            self.assertAlmostEqual(frequency, order * speed)
            self.assertTrue(speed == top or frequency == right, "on the border")
        for line in panel.lines:
            self.assertTrue(line.get_ydata()[0] in (low, top) or line.get_xdata()[0] == right)

    def test_orders_of_any_number_of_blades_have_one_mark_each(self):
        waterfall = importlib.import_module("rubatlas.plots.waterfall")
        self.assertEqual(waterfall.order_names(1), {1: "1× = n", 2: "2× = 2n", 3: "3×"})
        self.assertEqual(waterfall.order_names(5), {1: "1×", 2: "2×", 3: "3×", 5: "5× = n", 10: "10× = 2n"})

    def test_a_waterfall_names_as_many_orders_as_fit_without_overprinting(self):
        waterfall = importlib.import_module("rubatlas.plots.waterfall")
        for blades, top, names in ((3, 4.0, ["1×", "2×", "3× = n", "6× = 2n"]),
                                   (50, 60.0, ["1×", "50× = n", "100× = 2n"]),  # 2× and 3× are as good as at 1×
                                   (400, 4.0, ["1×", "2×", "3×", "400× = n"])):  # and 2n at n, on the right
            figure, panel = plt.subplots()
            panel.set(xlim=(0.0, top), ylim=(0.0, 1.0))
            waterfall.mark_orders(panel, top, blades)
            self.assertEqual([text.get_text() for text in panel.texts], names)
            plt.close(figure)

    def test_speeds_without_a_motion_are_shaded_behind_the_displacement(self):
        figure = Figure("displacement", TINY / "atlas.h5")
        self.assertIn("left the model's validity", figure.texts())
        with AtlasFile(TINY / "atlas.h5") as atlas:
            speed = atlas.axis("speed_ratio")
            missing = np.mean([line.status() == 2 for line in atlas.lines("damping_ratio")], axis=0)
        shade = np.zeros(len(speed))
        for patch in figure.figure.axes[0].patches:
            left, right = patch.get_extents().transformed(figure.figure.axes[0].transData.inverted()).intervalx
            shade[(speed > left) & (speed < right)] = patch.get_alpha()
        np.testing.assert_allclose(shade, np.where(missing > 0, 0.25 + 0.75 * missing, 0.0), rtol=1e-12)
        self.assertTrue(0.0 < missing.max() < 1.0)

    def test_a_point_between_points_without_a_motion_has_a_mark(self):
        _, panel = plt.subplots()
        style.curve(panel, np.arange(7), np.array([1.0, np.nan, 2.0, np.nan, 3.0, 4.0, np.nan]), color="k")
        line, = panel.lines
        self.assertEqual(line.get_marker(), ".")
        np.testing.assert_array_equal(np.flatnonzero(line.get_markevery()), [0, 2])
        for tool, of_it in (("displacement", 0), ("bifurcation", 2), ("signature", 2)):
            maps = ["--maps", TINY / "maps.h5"] if tool == "signature" else []
            line = Figure(tool, TINY / "atlas.h5", "--damping_ratio", 0.05, *maps).figure.axes[of_it].lines[0]
            known = np.isfinite(line.get_ydata())
            alone = [is_known and not np.any(known[max(i - 1, 0):i]) and not np.any(known[i + 1:i + 2])
                     for i, is_known in enumerate(known)]
            np.testing.assert_array_equal(line.get_markevery(), alone, tool)

    def test_speeds_that_are_not_evenly_spaced_are_shaded_up_to_halfway(self):
        np.testing.assert_allclose(style.edges_of([0.1, 0.2, 0.4]), [0.05, 0.15, 0.3, 0.5])
        self.assertEqual(len(style.edges_of([0.3])), 2)

    def test_a_displacement_is_drawn_over_the_clearance_of_its_own_line(self):
        figure = Figure("displacement", TINY / "rings.h5", "--damping_ratio", 0.1)
        self.assertIn("clearance 9 to 10 mm", figure.texts())
        with AtlasFile(TINY / "rings.h5") as atlas:
            for curve, radius in zip(figure.figure.axes[0].lines, (0.109, 0.11)):
                displacement = atlas.line(ring_radius=radius, damping_ratio=0.1).rows("max_displacement")
                np.testing.assert_allclose(curve.get_ydata(), displacement / (radius - 0.1), rtol=1e-12)

    def test_pictures_over_the_speed_have_a_second_axis_in_rpm(self):
        atlas, maps = TINY / "atlas.h5", ("--maps", TINY / "maps.h5")
        for tool, arguments in (("bifurcation", []), ("stack", []), ("displacement", []), ("map", maps),
                                ("margin", maps), ("signature", maps), ("waterfall", [])):
            with self.subTest(tool):
                figure = Figure(tool, atlas, *arguments).figure
                figure.draw_without_rendering()  # the second axis follows the first when it is drawn
                panel = figure.axes[0]
                second, = panel.child_axes
                upwards = tool == "waterfall"
                self.assertEqual((second.get_ylabel if upwards else second.get_xlabel)(), "Speed [rpm]")
                first = np.array((panel.get_ylim if upwards else panel.get_xlim)())
                np.testing.assert_allclose((second.get_ylim if upwards else second.get_xlim)(),
                                           first * 10.0 * 30 / np.pi)  # natural frequency 10 rad/s
        rpm = Figure("displacement", TINY / "rings.h5").figure.axes[0].child_axes
        self.assertEqual(len(rpm), 1, "two rings have one natural frequency")

    def test_the_axis_in_rpm_stands_beyond_the_words_of_the_speed(self):
        panel = style.subplots(argparse.Namespace(width=None), 1, 1, (8.5, 6.2))[1][0, 0]
        panel.set_ylim(0.6870, 0.6880)
        panel.set_ylabel("Speed ratio")
        style.rpm_axis(panel, {"radian_per_second": 0.1}, upwards=True)
        panel.figure.draw_without_rendering()
        second, = panel.child_axes
        beyond = second.spines["left"].get_window_extent().x1
        self.assertLess(beyond, panel.yaxis.label.get_window_extent().x0)

    def test_a_spectrum_without_any_vibration_is_no_picture_of_one(self):
        with AtlasFile(TINY / "atlas.h5") as atlas:
            line = atlas.line(damping_ratio=0.1)
            rows = {"spectrum": np.zeros_like(line.rows("spectrum"))}
            panel = style.subplots(argparse.Namespace(width=None), 1, 1, (8.5, 6.2))[1][0, 0]
            with unittest.mock.patch.object(line, "rows", rows.get):
                image, _ = waterfall.into(panel, line)
            style.colour_bar(image, "amplitude", ax=panel)
        self.assertEqual(len(panel.figure.axes), 1, "nothing has a colour")
        self.assertIn("below 1e-09 mm at all speeds", [text.get_text() for text in panel.texts])

    def test_where_there_is_no_margin_the_legend_says_why(self):
        texts = [text.get_text() for axes in Figure("margin", TINY / "atlas.h5", "--maps", TINY / "maps.h5").figure.axes
                 for text in (axes.get_legend().get_texts() if axes.get_legend() else [])]
        self.assertEqual(texts, ["left the model's validity", "no grazing is predicted"])

    def test_the_dots_are_the_sections_of_the_atlas(self):
        figure = Figure("bifurcation", TINY / "atlas.h5", "--damping_ratio", 0.1).figure
        with AtlasFile(TINY / "atlas.h5") as atlas:
            sections = atlas.line(damping_ratio=0.1).rows("poincare")
        for panel, component in zip(figure.axes, (0, 1)):
            drawn = panel.lines[0].get_ydata()
            np.testing.assert_array_equal(drawn, 1e3 * sections[:, :, component].ravel())

    def test_the_largest_displacement_is_read_in_clearances_too(self):
        figure = Figure("bifurcation", TINY / "atlas.h5").figure
        figure.draw_without_rendering()  # the second axis follows the first when it is drawn
        panel = figure.axes[2]
        in_clearances, = panel.child_axes
        np.testing.assert_allclose(np.array(panel.get_ylim()) / in_clearances.get_ylim()[1],
                                   [0.0, 10.0], atol=1e-12)  # mm, of the default rotor

    def test_a_zoom_shows_the_sections_of_its_range_above_their_classes(self):
        figure = Figure("bifurcation", TINY / "atlas.h5", "--maps", TINY / "maps.h5", "--damping_ratio", 0.05,
                        "--zoom", "0.25:0.5", "--zoom", "0.6:0.8").figure
        with AtlasFile(TINY / "atlas.h5") as atlas, AtlasFile(TINY / "maps.h5") as maps:
            speed, line = atlas.axis("speed_ratio"), atlas.line(damping_ratio=0.05)
            y, motion = 1e3 * line.rows("poincare")[:, :, 1], maps.dataset("class")[line.index]
        self.assertGreater(len(set(motion)), 2)
        colour = {kind: style.matplotlib.colors.to_rgba(entry["colour"]) for entry in PALETTE["classes"]
                  for kind in range(entry["first"], entry["last"] + 1)}
        colour[0], = (style.matplotlib.colors.to_rgba(entry["colour"]) for entry in PALETTE["no_motion"]
                      if entry["status"] == 2)
        for panel, (low, high) in zip(figure.axes[3:], ((0.25, 0.5), (0.6, 0.8))):
            within = (speed >= low) & (speed <= high)
            np.testing.assert_array_equal(panel.lines[0].get_ydata(), y[within].ravel())
            self.assertEqual(panel.get_xlim(), (low, high))
            strip, = panel.child_axes
            image, (left, right, *_) = strip.images[0].get_array()[0], strip.images[0].get_extent()
            cell = ((speed[within] - left) / (right - left) * within.sum()).astype(int)
            np.testing.assert_array_equal(image[cell], [colour[kind] for kind in motion[within]])
            least, most = panel.get_ylim()  # no dot stands where the strip does
            self.assertGreater(np.nanmin(y[within]), least + 0.05 * (most - least))

    def test_a_zoom_is_a_range_of_speeds_that_the_atlas_has(self):
        for word in ("0.5", "0.5:0.4", "a:b", "0.1:0.2:0.3", "nan:nan"):
            ended = run("bifurcation", TINY / "atlas.h5", "-o", "none.png", f"--zoom={word}")
            self.assertEqual(ended.returncode, 2)
            self.assertIn(f"--zoom: {word} is no range of speed ratios, such as 0.22:0.335", ended.stderr)
        ended = run("bifurcation", TINY / "atlas.h5", "-o", "none.png", "--zoom=0.92:0.95")
        self.assertEqual(ended.returncode, 2)
        self.assertRegex(ended.stderr, r"^rubatlas-plot bifurcation: --zoom 0.92:0.95: .*atlas.h5 has 0 speeds there, "
                                       r"and its speeds go from 0.2 to 0.9\n$")

    def test_a_stack_has_a_bifurcation_diagram_for_each_value_with_aperiodic_motions_lighter(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        # The tiny atlas has no motion that its few sections show to be aperiodic.
        marked = pathlib.Path(folder.name) / "marked.h5"
        shutil.copy(TINY / "maps.h5", marked)
        with h5py.File(marked, "r+") as maps:
            maps["class"][..., 1, 10:20] = 255
        figure = Figure("stack", TINY / "atlas.h5", "--maps", marked).figure
        self.assertEqual([panel.get_ylabel() for panel in figure.axes], ["ζ = 0.05", "ζ = 0.1", "ζ = 0.2"])
        self.assertEqual(len({(panel.get_xlim(), panel.get_ylim()) for panel in figure.axes}), 1)
        with AtlasFile(TINY / "atlas.h5") as atlas, AtlasFile(marked) as maps:
            for panel, line in zip(figure.axes, atlas.lines("damping_ratio")):
                y, aperiodic = 1e3 * line.rows("poincare")[:, :, 1], maps.dataset("class")[line.index] == 255
                self.assertEqual(aperiodic.sum(), 10 if line.value("damping_ratio") == 0.1 else 0)
                lighter, darker = panel.lines
                np.testing.assert_array_equal(lighter.get_ydata(), y[aperiodic].ravel())
                np.testing.assert_array_equal(darker.get_ydata(), y[~aperiodic].ravel())
                lightness = [sum(style.matplotlib.colors.to_rgb(dots.get_color())) for dots in (lighter, darker)]
                self.assertGreater(lightness[0], lightness[1] + 0.5)
        self.assertEqual(len(Figure("stack", TINY / "atlas.h5").figure.axes[0].lines), 1, "no maps lie beside it")

    def test_a_stack_draws_the_values_and_the_component_that_are_asked_for(self):
        figure = Figure("stack", TINY / "rings.h5", "--values", "0.11", "--component", "x").figure
        panel, = figure.axes
        self.assertEqual(panel.get_ylabel(), "ring radius\n110 mm")
        with AtlasFile(TINY / "rings.h5") as atlas:
            x = 1e3 * atlas.line(ring_radius=0.11).rows("poincare")[:, :, 0]
        drawn = np.concatenate([dots.get_ydata() for dots in panel.lines])
        np.testing.assert_array_equal(np.sort(drawn), np.sort(x.ravel()))
        ended = run("stack", TINY / "atlas.h5", "-o", "none.png", "--values", "0.05,0.7")
        self.assertEqual(ended.returncode, 2)
        self.assertRegex(ended.stderr, r"^rubatlas-plot stack: .*damping_ratio 0.7 is not in this atlas.*\n$")

    def test_the_waterfall_puts_a_line_at_its_order_times_the_speed(self):
        waterfall = importlib.import_module("rubatlas.plots.waterfall")
        order, speed = np.arange(0, 121) / 10.0, np.array([0.2, 0.5])
        amplitude = np.zeros((2, 121))
        amplitude[:, 30] = 1.0  # order 3
        edges = np.linspace(0.0, 4.0, 401)
        shown = waterfall.by_frequency(speed, order, amplitude, edges)
        middle = 0.5 * (edges[1:] + edges[:-1])
        for row, ratio in zip(shown, speed):
            lit = middle[row == 1.0]
            self.assertTrue(len(lit) and np.all(np.abs(lit - 3.0 * ratio) <= 0.5 * 0.1 * ratio + 0.01), lit)

    def test_the_waterfall_is_blank_beyond_the_highest_order_and_has_no_mean_position(self):
        waterfall = importlib.import_module("rubatlas.plots.waterfall")
        order, amplitude = np.arange(0, 13) / 2.0, np.ones((2, 13))
        amplitude[:, 0] = 9.0
        shown = waterfall.by_frequency(np.array([0.25, 0.5]), order, amplitude, np.linspace(0.0, 4.0, 401))
        np.testing.assert_array_equal(np.isnan(shown).argmax(axis=1), [151, 301])  # the highest line is at 150
        np.testing.assert_array_equal(shown[np.isfinite(shown)], 1.0)
        figure = Figure("waterfall", TINY / "atlas.h5", "--damping_ratio", 0.05)
        self.assertIn("left the model's validity", figure.texts())
        spectra, missing = figure.figure.axes[0].images
        with AtlasFile(TINY / "atlas.h5") as atlas:
            status = atlas.line(damping_ratio=0.05).status()
        np.testing.assert_array_equal(missing.get_array()[:, 0, 3] > 0, status == 2)
        np.testing.assert_array_equal(np.ma.getmaskarray(spectra.get_array())[:, 0], status == 2)

    def test_the_waterfall_keeps_the_height_of_a_narrow_line(self):
        waterfall = importlib.import_module("rubatlas.plots.waterfall")
        order, amplitude = np.arange(0, 1201) / 100.0, np.full((1, 1201), 1e-6)
        amplitude[0, 100] = 0.7
        shown = waterfall.by_frequency(np.array([0.5]), order, amplitude, np.linspace(0.0, 4.0, 41))
        self.assertEqual(shown.max(), 0.7)


if __name__ == "__main__":
    unittest.main()

"""Every picture: it is drawn by its command, holds what the atlas holds, and is labelled from the file."""
import contextlib
import importlib
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import h5py
import numpy as np

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
TINY = pathlib.Path(os.environ["RUBATLAS_PROGRAM"]).parent / "tests/tiny_atlas"
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tests/support")]
from forked_commands import ended_command  # noqa: E402
from rubatlas import style  # noqa: E402
from rubatlas.atlas_file import AtlasFile  # noqa: E402
from rubatlas.palette import PALETTE  # noqa: E402
from rubatlas.plots import KINDS  # noqa: E402


def run(tool, *arguments):
    """Runs a tool as its user does."""
    return ended_command("rubatlas-plot", tool, *arguments)


class Figure:
    """A picture caught just before it is written, to look at what it holds."""

    def __init__(self, tool, *arguments):
        module = importlib.import_module(f"rubatlas.plots.{tool}")
        caught = []
        with unittest.mock.patch.object(style, "save", lambda figure, options: caught.append(figure)), \
                contextlib.redirect_stdout(io.StringIO()):
            module.main([*map(str, arguments), "-o", "none.png"])
        self.figure = caught[0]
        style.plt.close(self.figure)  # pyplot forgets it

    def texts(self):
        parts = [self.figure._suptitle.get_text(), self.figure._supxlabel.get_text()]
        for axes in self.figure.axes:
            parts += [axes.get_title(loc="left"), axes.get_xlabel(), axes.get_ylabel()]
            parts += [text.get_text() for text in (axes.get_legend().get_texts() if axes.get_legend() else [])]
        return "\n".join(parts)


class ToolsPictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        subprocess.run([os.environ["RUBATLAS_PROGRAM"], "orbit", ROOT / "tests/tools/tiny.json", "--at",
                        "speed_ratio=0.4,damping_ratio=0.1", "-o", cls.folder / "other.h5"], check=True,
                       capture_output=True)

    def expect_picture(self, tool, *arguments, colours=20):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "picture.png"
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

    def test_the_spectrum_of_a_point_is_drawn(self):
        self.expect_picture("spectrum", TINY / "atlas.h5", "--speed_ratio", 0.6)

    def test_the_orbit_is_drawn(self):
        self.expect_picture("orbit", TINY / "orbit.h5")

    def test_basins_of_attraction_are_drawn(self):
        self.expect_picture("basins", TINY / "basins.h5", "--maps", TINY / "basins_maps.h5", "--dpi", 100, colours=10)

    def test_a_pixel_of_a_basin_has_the_colour_of_its_attractor(self):
        figure = Figure("basins", TINY / "basins.h5", "--maps", TINY / "basins_maps.h5")
        self.assertIn("Initial x [mm]", figure.texts())
        self.assertIn("Initial vx [mm]", figure.texts())
        with AtlasFile(TINY / "basins_maps.h5") as maps:
            motion, attractor = (maps.dataset(name)[:, :, 0, 0, 0, 0, :] for name in ("class", "attractor"))
        self.assertEqual(motion.shape, (5, 7, 2))  # initial_vx, initial_x, speed_ratio
        self.assertEqual(set(attractor[:, :, 0].ravel()), {1})
        self.assertLessEqual({1, 11}, set(motion[:, :, 1].ravel()))
        colour = {kind: style.matplotlib.colors.to_rgba(entry["colour"]) for entry in PALETTE["classes"]
                  for kind in range(entry["first"], entry["last"] + 1)}
        for speed, panel in enumerate(figure.figure.axes):
            wanted = [[colour[kind] for kind in row] for row in motion[:, :, speed]]
            np.testing.assert_array_equal(panel.images[0].get_array(), wanted)
            left, right, bottom, top = panel.images[0].get_extent()
            np.testing.assert_allclose([left, right, bottom, top], [-0.5, 6.5, 3.25, 10.75])  # mm, half a step around

    def test_attractors_of_one_colour_have_hatchings_of_their_own(self):
        basins = importlib.import_module("rubatlas.plots.basins")
        attractor, motion = np.array([[1, 2], [3, 4]]), np.array([[7, 7], [1, 9]])
        found = [entry for entry, where in basins.cells_of(attractor, motion, np.ones((2, 2))) if where.any()]
        self.assertEqual([entry["name"] for entry in found],
                         ["1: period 7, 25.0 %", "2: period 7, 25.0 %", "3: period 1, 25.0 %", "4: period 9, 25.0 %"])
        self.assertEqual(len({entry["colour"] for entry in found}), 2)
        self.assertEqual(len({(entry["colour"], entry["hatch"]) for entry in found}), 4)

    def test_basins_need_an_axis_of_the_initial_state(self):
        ended = run("basins", TINY / "atlas.h5", "--maps", TINY / "maps.h5", "-o", "none.png")
        self.assertEqual(ended.returncode, 2)
        self.assertRegex(ended.stderr,
                         r"^rubatlas-plot basins: .*: no axis of the initial state is left to draw over; "
                         r"the atlas has .*\n$")

    def test_an_effect_is_drawn_beside_its_absence(self):
        self.expect_picture("effect", TINY / "gravity.h5", "--without", TINY / "atlas.h5", "--dpi", 100)

    def test_forces_of_an_orbit_are_drawn_up_to_their_peaks(self):
        forces = Figure("orbit", TINY / "orbit.h5", "--revolutions", 16).figure.axes[1]
        with h5py.File(TINY / "orbit.h5") as orbit:
            blade, force = orbit["contact_blade"][:], orbit["contact_force"][:]
            sampled = orbit["force"][:].max(axis=0)
        self.assertEqual(len(forces.lines), 3)
        for number, curve in enumerate(forces.lines):
            drawn = curve.get_ydata()
            self.assertEqual(np.nanmax(drawn), force[blade == number + 1].max())
            self.assertGreaterEqual(np.nanmax(drawn), sampled[number])
            gaps = np.flatnonzero(np.isnan(drawn))  # each contact rises from zero and returns to it
            np.testing.assert_array_equal(drawn[gaps - 1], 0.0)
            np.testing.assert_array_equal(drawn[np.concatenate([[0], gaps[:-1] + 1])], 0.0)
        self.assertGreater(max(np.diff(line.get_ydata()[~np.isnan(line.get_ydata())]).size for line in forces.lines),
                           50)

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

    def test_speeds_that_are_not_evenly_spaced_are_shaded_up_to_halfway(self):
        np.testing.assert_allclose(style.edges_of([0.1, 0.2, 0.4]), [0.05, 0.15, 0.3, 0.5])
        self.assertEqual(len(style.edges_of([0.3])), 2)

    def test_every_picture_has_its_command(self):
        pages = "".join((ROOT / page).read_text() for page in ("README.md", "tools/README.md", "tools/gallery.md"))
        for kind in KINDS:
            self.assertIn(f"rubatlas-plot {kind} ", pages)
            module = importlib.import_module(f"rubatlas.plots.{kind}")
            self.assertTrue(module.__doc__ and module.main)

    def test_all_pictures_of_an_atlas_are_drawn_at_once(self):
        with tempfile.TemporaryDirectory() as folder:
            ended = run("all", TINY / "atlas.h5", "--maps", TINY / "maps.h5", "-o", folder)
            self.assertEqual((ended.returncode, ended.stderr), (0, ""))
            drawn = sorted(pathlib.Path(folder).iterdir())
            for path in drawn:
                with self.subTest(path.stem):
                    self.expect_drawn(path, colours=50 if "sensitivity" in path.stem else 20)
        self.assertEqual([path.name for path in drawn],
                         ["bifurcation.png", "blade.png", "displacement.png", "sensitivity.png",
                          "sensitivity_blade_passing.png", "stack.png", "waterfall.png"])

    def test_of_many_initial_states_the_basins_are_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            ended = run("all", TINY / "basins.h5", "-o", folder)
            self.assertEqual((ended.returncode, ended.stderr), (0, ""))
            self.assertEqual([path.name for path in pathlib.Path(folder).iterdir()], ["basins.png"])

    def test_all_pictures_are_drawn_where_a_quantity_is_swept_by_its_pointer_in_the_width_that_is_asked_for(self):
        with tempfile.TemporaryDirectory() as folder:
            ended = run("all", TINY / "rings.h5", "--width", "85mm", "--dpi", "100", "-o", folder)
            self.assertEqual((ended.returncode, ended.stderr), (0, ""))
            pictures = sorted(pathlib.Path(folder).glob("*.png"))
            names = [path.stem for path in pictures]
            self.assertLessEqual({style.plt.imread(path).shape[1] for path in pictures}, {334, 335})
        self.assertEqual(names, ["bifurcation", "blade", "displacement", "displacement_damping_ratio", "sensitivity",
                                 "sensitivity_damping_ratio", "stack", "stack_damping_ratio", "waterfall"])
        self.assertIn("Ring radius [mm]", Figure("map", TINY / "rings.h5").texts())
        self.assertIn("ring radius 0.11 m",
                      Figure("bifurcation", TINY / "rings.h5", "--at", "ring_radius=0.11").texts())

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

    def test_the_title_says_which_line_is_drawn(self):
        texts = Figure("bifurcation", TINY / "atlas.h5", "--damping_ratio", 0.2).texts()
        self.assertIn("Tiny atlas", texts)
        self.assertIn("damping ratio 0.2", texts)
        self.assertIn("made by the tests", texts)

    def test_axes_carry_the_names_and_units_of_the_file(self):
        texts = Figure("bifurcation", TINY / "atlas.h5").texts()
        self.assertIn("Speed ratio Ω [-]", texts)
        self.assertIn("max. displacement [mm]", texts)
        self.assertIn("Damping ratio ζ [-]", Figure("map", TINY / "atlas.h5").texts())

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
        marked = self.folder / "marked.h5"  # the tiny atlas has no motion that its few sections show to be aperiodic
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

    def test_several_orbits_have_a_panel_each_with_sections_clearance_and_middle_of_the_ring(self):
        figure = Figure("orbit", TINY / "orbit.h5", self.folder / "other.h5").figure
        *planes, bottom = figure.axes
        self.assertEqual(len(planes), 2)
        for plane, path, speed in zip(planes, (TINY / "orbit.h5", self.folder / "other.h5"), (0.3, 0.4)):
            with h5py.File(path) as orbit:
                state, sections = orbit["state"][:], orbit["sections"][:]
            self.assertTrue(plane.get_title(loc="left").endswith(f"speed ratio {speed}"))
            path_of, dots, circle, middle = plane.lines
            np.testing.assert_array_equal(path_of.get_xydata(), 1e3 * state[:, :2])
            np.testing.assert_array_equal(dots.get_xydata(), 1e3 * sections[:, :2])
            np.testing.assert_allclose(middle.get_xydata(), [[0.0, -10.01]])  # mm, the misalignment
            np.testing.assert_allclose(np.hypot(*(circle.get_xydata() - middle.get_xydata()).T), 10.0)  # mm
        self.assertIn("damping ratio 0.1", planes[0].get_title(loc="left"))
        self.assertEqual([text.get_text() for text in bottom.get_legend().get_texts()],
                         ["orbit", "section, once per revolution", "clearance 10 mm", "middle of the ring"])

    def test_orbits_of_different_rotors_are_not_drawn_together(self):
        ended = run("orbit", TINY / "orbit.h5", TINY / "rings_orbit.h5", "-o", "none.png")
        self.assertEqual(ended.returncode, 2)
        self.assertRegex(ended.stderr, r"^rubatlas-plot orbit: .*rings_orbit.h5 was not made from the scene of "
                                       r".*orbit.h5: /ring/radius is 0.11 here and 0.1095 there\n$")

    def test_only_what_shows_a_figure_of_the_paper_bears_its_number(self):
        drawn = re.findall(r"(fig\w+\.png)", (ROOT / "jobs/figures.sh").read_text())
        self.assertEqual(len(drawn), 8)
        self.assertEqual({path.name for path in (ROOT / "tools/pictures").glob("fig*")}, set(drawn))
        gallery = (ROOT / "tools/gallery.md").read_text()
        for words, path in re.findall(r"!\[([^]]*)\]\(pictures/([^)]*)\)", gallery):
            self.assertEqual(words.startswith("Fig."), path in drawn, words)

    def test_the_map_has_one_row_per_value_of_the_parameter(self):
        figure = Figure("map", TINY / "atlas.h5", "--maps", TINY / "maps.h5").figure
        image = figure.axes[0].images[0].get_array()
        with AtlasFile(TINY / "atlas.h5") as atlas:
            wanted = [1e3 * atlas.line(damping_ratio=value).rows("max_displacement") for value in (0.05, 0.1, 0.2)]
        largest = np.nanmax(wanted)  # the map covers three decades below it
        np.testing.assert_array_equal(np.ma.filled(image, np.nan), np.maximum(wanted, 1e-3 * largest))

    def test_points_without_a_motion_are_covered_and_said_to_be_so(self):
        figure = Figure("map", TINY / "atlas.h5", "--maps", TINY / "maps.h5")
        with AtlasFile(TINY / "atlas.h5") as atlas:
            missing = np.array([line.status() for line in atlas.lines("damping_ratio")]) == 2
        self.assertTrue(missing.any() and not missing.all())
        np.testing.assert_array_equal(figure.figure.axes[0].images[1].get_array()[:, :, 3] > 0, missing)
        self.assertIn("left the model's validity", figure.texts())

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

    def test_the_waterfall_keeps_the_height_of_a_narrow_line(self):
        waterfall = importlib.import_module("rubatlas.plots.waterfall")
        order, amplitude = np.arange(0, 1201) / 100.0, np.full((1, 1201), 1e-6)
        amplitude[0, 100] = 0.7
        shown = waterfall.by_frequency(np.array([0.5]), order, amplitude, np.linspace(0.0, 4.0, 41))
        self.assertEqual(shown.max(), 0.7)

    def test_a_mistake_is_one_sentence_and_exit_code_2(self):
        ended = run("bifurcation", TINY / "atlas.h5", "-o", "none.png", "--damping_ratio", "0.7")
        self.assertEqual(ended.returncode, 2)
        self.assertRegex(ended.stderr,
                         r"^rubatlas-plot bifurcation: .*damping_ratio 0.7 is not in this atlas, "
                         r"which has 0.05, 0.1, 0.2\n$")


if __name__ == "__main__":
    unittest.main()

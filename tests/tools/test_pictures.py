"""Every picture: it is drawn by its command, holds what the atlas holds, and is labelled from the file."""
import importlib
import json
import os
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

import h5py
import numpy as np

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tests/support")]
from pictures import TINY, Figure, PicturesCase, run, unplaced  # noqa: E402
from rubatlas import elastica, style  # noqa: E402
from rubatlas.atlas_file import AtlasFile  # noqa: E402
from rubatlas.plots import KINDS  # noqa: E402


class ToolsPictures(PicturesCase):
    def test_an_effect_is_drawn_beside_its_absence(self):
        self.expect_picture("effect", TINY / "gravity.h5", "--without", TINY / "atlas.h5", "--dpi", 100)

    def test_every_picture_has_its_command(self):
        pages = "".join((ROOT / page).read_text() for page in ("README.md", "tools/README.md", "tools/gallery.md"))
        for kind in KINDS:
            self.assertIn(f"rubatlas-plot {kind} ", pages)
            module = importlib.import_module(f"rubatlas.plots.{kind}")
            self.assertTrue(module.__doc__ and module.main)

    def test_all_pictures_of_an_atlas_are_drawn_at_once(self):
        with tempfile.TemporaryDirectory() as folder:
            with unplaced():
                ended = run("all", TINY / "atlas.h5", "--maps", TINY / "maps.h5", "-o", folder)
            self.assertEqual((ended.returncode, ended.stderr), (0, ""))
            drawn = sorted(pathlib.Path(folder).iterdir())
            for path in drawn:
                with self.subTest(path.stem):
                    self.expect_drawn(path, colours=50 if "sensitivity" in path.stem else 20)
        self.assertEqual([path.name for path in drawn],
                         ["bifurcation.png", "blade.png", "displacement.png", "margin.png", "sensitivity.png",
                          "sensitivity_blade_passing.png", "signature.png", "stack.png", "waterfall.png"])

    def test_without_maps_all_draws_what_needs_none(self):
        with tempfile.TemporaryDirectory() as folder:
            atlas, pictures = pathlib.Path(folder) / "atlas.h5", pathlib.Path(folder) / "pictures"
            shutil.copy(TINY / "atlas.h5", atlas)
            with unplaced():
                ended = run("all", atlas, "--dpi", 20, "-o", pictures)
            self.assertEqual(ended.returncode, 0)
            self.assertEqual(re.findall(r"all: (\w+) is left out: .*: no maps beside it", ended.stderr),
                             ["signature", "margin"])
            self.assertEqual(sorted(path.stem for path in pictures.iterdir()),
                             ["bifurcation", "blade", "displacement", "sensitivity", "stack", "waterfall"])

    def changed(self, folder, change, *names):
        """Copies of files of the tiny atlas, with a change to their scene."""
        paths = [pathlib.Path(folder) / name for name in names]
        for path in paths:
            shutil.copy(TINY / path.name, path)
            with h5py.File(path, "r+") as file:
                scene = json.loads(file["scene_resolved"][()])
                change(scene)
                file["scene_resolved"][()] = json.dumps(scene)
        return paths

    def test_dollar_signs_in_a_title_are_drawn_as_they_are(self):
        def in_dollars(scene):
            scene["title"], scene["reference"] = r"Rotors of $3 and $5", r"costs $\nowhere$ stated"

        with tempfile.TemporaryDirectory() as folder:
            path, = self.changed(folder, in_dollars, "atlas.h5")
            figure = Figure("displacement", path).figure
            figure.canvas.draw()  # which fails where the words between dollar signs are read as formulas
            titles = figure._suptitle, figure._supxlabel
            drawn = [title.get_window_extent().width for title in titles]
            for title in titles:
                title.set_text(title.get_text().replace("$", r"\$")), title.set_parse_math(True)  # written out
            figure.canvas.draw()
            np.testing.assert_allclose(drawn, [title.get_window_extent().width for title in titles], rtol=0.02)

    def test_what_cannot_be_drawn_is_left_out_with_its_reason_and_the_others_are_drawn(self):
        def without_clearance(scene):
            scene["ring"]["radius"] = scene["blades"]["hub_radius"] + scene["blades"]["length"]

        with tempfile.TemporaryDirectory() as folder:
            atlas, maps = self.changed(folder, without_clearance, "atlas.h5", "maps.h5")
            pictures = pathlib.Path(folder) / "pictures"
            with unplaced():
                ended = run("all", atlas, "--maps", maps, "--dpi", 20, "-o", pictures)
            self.assertEqual(ended.returncode, 0)
            self.assertRegex(ended.stderr, r"\Arubatlas-plot all: displacement is left out: [^\n]* has no clearance "
                                           r"[^\n]*\n\Z")
            drawn = {path.stem for path in pictures.iterdir()}
            self.assertGreaterEqual(drawn, {"bifurcation", "sensitivity", "margin", "signature", "blade"})
            self.assertEqual(len(drawn), 8)

    def test_all_pictures_are_drawn_where_a_quantity_is_swept_by_its_pointer_in_the_width_that_is_asked_for(self):
        with tempfile.TemporaryDirectory() as folder:
            with unplaced():
                ended = run("all", TINY / "rings.h5", "--width", "85mm", "--dpi", "100", "-o", folder)
            self.assertEqual(ended.returncode, 0)
            self.assertRegex(ended.stderr, r"\A([^\n]*: sensitivity_blade_passing\w* is left out: [^\n]* it has no "
                                           r"/class_blade_passing; [^\n]*poincare_blade_passing\n){2}\Z")
            pictures = sorted(pathlib.Path(folder).glob("*.png"))
            names = [path.stem for path in pictures]
            self.assertLessEqual({style.plt.imread(path).shape[1] for path in pictures}, {334, 335})
        self.assertEqual(names, ["bifurcation", "blade", "displacement", "displacement_damping_ratio", "margin",
                                 "margin_damping_ratio", "sensitivity", "sensitivity_damping_ratio", "signature",
                                 "stack", "stack_damping_ratio", "waterfall"])
        self.assertIn("Ring radius [mm]", Figure("map", TINY / "rings.h5").texts())
        self.assertIn("ring radius 0.11 m",
                      Figure("bifurcation", TINY / "rings.h5", "--at", "ring_radius=0.11").texts())

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

    def test_cells_of_an_axis_of_uneven_steps_lie_where_its_values_are(self):
        speed = np.array([0.6, 0.605, 0.61, 0.7, 0.9])
        _, panel = style.plt.subplots()
        place = style.edges_of(speed), np.array([-0.5, 0.5])
        image = style.image_into(panel, np.arange(5.0)[np.newaxis], place)
        left, right, *_ = image.get_extent()
        row = image.get_array()[0]
        np.testing.assert_array_equal(row[((speed - left) / (right - left) * len(row)).astype(int)], np.arange(5))
        entry = {"name": "hatched", "colour": "red", "hatch": "/"}
        style.cells_into(panel, [(entry, speed[np.newaxis] == 0.7)], place)
        np.testing.assert_allclose(panel.patches[0].get_path().vertices[:2, 0], [0.655, 0.8])

    def test_points_without_a_motion_are_covered_and_said_to_be_so(self):
        figure = Figure("map", TINY / "atlas.h5", "--maps", TINY / "maps.h5")
        with AtlasFile(TINY / "atlas.h5") as atlas:
            missing = np.array([line.status() for line in atlas.lines("damping_ratio")]) == 2
        self.assertTrue(missing.any() and not missing.all())
        np.testing.assert_array_equal(figure.figure.axes[0].images[1].get_array()[:, :, 3] > 0, missing)
        self.assertIn("left the model's validity", figure.texts())

    def test_a_blade_is_drawn_as_its_contact_law_bends_it(self):
        with tempfile.TemporaryDirectory() as folder:
            ends = []
            for law in ("elastica", "beam_column", "elastic_ring"):
                path, = self.changed(folder, lambda scene, law=law: scene["contact"].update(law=law), "atlas.h5")
                if law != "elastic_ring":
                    ends.append(Figure("blade", path).figure.axes[0].lines[0].get_xdata()[-1])
            self.assertLess(ends[1], elastica.EULER_LOAD * 17.17)  # [N], of the default blade
            self.assertGreater(ends[0], ends[1])
            ended = run("blade", path, "-o", "none.png")
            self.assertEqual(ended.returncode, 2)
            self.assertIn("elastic_ring, under which blades are rigid; elastica and beam_column have", ended.stderr)

    def test_a_mistake_is_one_sentence_and_exit_code_2(self):
        ended = run("bifurcation", TINY / "atlas.h5", "-o", "none.png", "--damping_ratio", "0.7")
        self.assertEqual(ended.returncode, 2)
        self.assertRegex(ended.stderr,
                         r"^rubatlas-plot bifurcation: .*damping_ratio 0.7 is not in this atlas, "
                         r"which has 0.05, 0.1, 0.2\n$")


if __name__ == "__main__":
    unittest.main()

"""Work-precision diagrams and the table of accuracy: what they say is what the study holds."""
import argparse
import os
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

import numpy as np

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
TINY = pathlib.Path(os.environ["RUBATLAS_PROGRAM"]).parent / "tests/tiny_atlas"
ORBITS = ROOT / "tests/reference/orbits.json"
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tests/support")]
from forked_commands import ended_command  # noqa: E402
from rubatlas.plots import accuracy  # noqa: E402
from rubatlas import style  # noqa: E402
from rubatlas.accuracy_file import AccuracyFile  # noqa: E402
from rubatlas.atlas_file import AtlasError  # noqa: E402


def run(*arguments):
    """Runs the tool as its user does."""
    return ended_command("rubatlas-plot", "accuracy", *arguments)


def study_with(**data):
    """The tiny study with some of its datasets replaced."""
    study = AccuracyFile(TINY / "accuracy.h5")
    study.data.update({name: np.asarray(values, dtype=float) for name, values in data.items()})
    return study


class ToolsAccuracy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.drawn = pathlib.Path(folder.name)
        cls.ended = run(TINY / "accuracy.h5", "-o", cls.drawn, "--reference", ORBITS)

    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def test_both_diagrams_are_drawn_and_the_table_is_printed(self):
        ended = self.ended
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        self.assertIn("| tolerance | trajectory error / δc | against the reference data |", ended.stdout)
        self.assertRegex(ended.stdout, r"\n\| 1e-07 \| \d")
        self.assertRegex(ended.stdout, r"\n\| `hybrid` \| tolerance 1e-0[79] \|")
        for name in ("accuracy.png", "accuracy_map.png"):
            pixels = style.plt.imread(self.drawn / name)[:, :, :3]
            self.assertTrue(0.01 < np.mean(np.any(pixels != 1.0, axis=2)) < 0.95, name)

    def test_the_same_study_gives_the_same_bytes_and_its_table_replaces_the_one_on_the_page_and_nothing_else(self):
        page = self.folder / "page.md"
        page.write_text(f"before\n{accuracy.BEGIN}\nold\n{accuracy.END}\nafter\n")
        ended = run(TINY / "accuracy.h5", "-o", self.folder, "--reference", ORBITS, "--page", page)
        for name in ("accuracy.png", "accuracy_map.png"):
            self.assertEqual((self.drawn / name).read_bytes(), (self.folder / name).read_bytes())
        self.assertEqual(page.read_text(), f"before\n{accuracy.BEGIN}\n{ended.stdout}{accuracy.END}\nafter\n")

    def test_errors_against_the_tightest_run_are_those_against_the_reference_data(self):
        study = AccuracyFile(TINY / "accuracy.h5")
        for points in (study.predictable(), ~study.predictable()):
            found, known = study.worst_error(points), study.error_against(ORBITS, points)
            # The tightest run has an error of its own, tolerance 1e-10; and chaos is known for ten sections only.
            self.assertLess(known[0], 1e-8 if points is not None and points[0] else 1e-5)
            for setting in study.of("hybrid"):
                self.assertLessEqual(known[setting], 1.1 * found[setting] + 2.0 * known[0])
        predictable = study.predictable()
        found, known = study.worst_error(predictable), study.error_against(ORBITS, predictable)
        for setting in study.of("hybrid")[:2]:
            self.assertAlmostEqual(known[setting] / found[setting], 1.0, delta=0.1)

    def test_reference_data_of_another_rotor_or_start_are_not_compared(self):
        study = AccuracyFile(TINY / "accuracy.h5")
        self.assertEqual(sorted(study.cases(ORBITS)), [0, 1, 2, 3])
        study.scene["rotor"]["mass"] = 2.0
        self.assertEqual(study.cases(ORBITS), {})
        with self.assertRaisesRegex(AtlasError, "no case has the rotor and the start of a point"):
            study.require_reference(ORBITS)
        started = study_with(start=np.full((1, 1, 1, 1, 4, 4), 1e-6))
        self.assertEqual(started.cases(ORBITS), {})

    def test_a_trusted_tolerance_is_the_loosest_from_which_on_the_map_stays(self):
        tolerance = lambda shares: [None if setting is None else study["tolerance"][setting]  # noqa: E731
                                    for study in [study_with(map_error_beyond_chaos=[0.0, *shares])]
                                    for setting in [accuracy.trusted(study)]][0]
        self.assertAlmostEqual(tolerance([0.25, 0.0, 0.0]), 1e-7)
        self.assertAlmostEqual(tolerance([0.0, 0.25, 0.0]), 1e-9)
        self.assertAlmostEqual(tolerance([0.0, 0.0, 0.0]), 1e-5)
        self.assertAlmostEqual(tolerance([0.25, 0.005, 0.005]), 1e-7)  # a point that no setting decides
        self.assertIsNone(tolerance([0.5, 0.25, 0.25]))

    def test_the_sentence_names_tolerance_time_and_the_price_of_ten_times_more(self):
        times = np.ones((4, 1, 1, 1, 1, 4)) * np.array([9.0, 2e-3, 4e-3, 5e-3]).reshape(4, 1, 1, 1, 1, 1)
        study = study_with(map_error_beyond_chaos=[0, 0.1, 0, 0], tolerance=[1e-9, 1e-6, 1e-7, 1e-8],
                           cpu_time_min=times)
        self.assertEqual(accuracy.sentence(study),
                         "For a map you can trust, use tolerance 1e-07; it costs 4.0 ms a point; "
                                                   "ten times more accurate costs 25 % more.")

    def test_axes_of_less_than_a_decade_have_numbers(self):
        times = np.ones((4, 1, 1, 1, 1, 4)) * np.array([0.130, 0.102, 0.110, 0.125]).reshape(4, 1, 1, 1, 1, 1)
        study, made = study_with(cpu_time_min=times), []
        options = argparse.Namespace(output=self.folder, width=None, dpi=None, reference=None)
        with unittest.mock.patch.object(style, "save", lambda figure, _: made.append(figure)):
            accuracy.draw_map(study, options)
            accuracy.draw_trajectories(study, options)
        for figure in made:
            figure.draw_without_rendering()
            for axes in figure.axes:
                low, high = axes.get_xlim()
                ticks = [*zip(axes.get_xticks(), axes.get_xticklabels()),
                         *zip(axes.get_xticks(minor=True), axes.get_xticklabels(minor=True))]
                self.assertTrue([place for place, label in ticks if low <= place <= high and label.get_text()])
            words = [label.get_text() for label in figure.axes[0].get_xticklabels(minor=True)]
            self.assertRegex("".join(words), "^1[0-9]+")

    def test_a_time_says_of_which_points_it_is(self):
        above, below = self.ended.stdout.split("On the points that are predictable to the end, ")
        self.assertIn("| ms a point of the map |", above)
        self.assertIn("| ms a predictable point |", below)

    def test_a_setting_that_lost_a_point_has_no_cost_to_compare(self):
        study = AccuracyFile(TINY / "accuracy.h5")
        everywhere = np.ones(study.point_count(), dtype=bool)
        np.testing.assert_array_equal(study.complete(everywhere), [True] * 4)
        study.done[2, 1] = False
        np.testing.assert_array_equal(study.complete(everywhere), [True, True, False, True])
        np.testing.assert_array_equal(study.complete(study.predictable()), [True] * 4)

    def test_methods_are_compared_at_an_error_that_both_reach(self):
        study = AccuracyFile(TINY / "accuracy.h5")
        study.words = ["hybrid", "fixed", "hybrid", "hybrid"]
        error = np.ones((4, 1, 1, 1, 1, 4)) * np.array([0, 1e-2, 1e-7, 1e-9]).reshape(4, 1, 1, 1, 1, 1)
        study.data["trajectory_error"] = error
        table = accuracy.method_table(study, 1e-6).splitlines()
        self.assertIn("not reached", table[2])
        self.assertIn("| `hybrid` | tolerance 1e-07 | 1.0e-07 |", table[3])
        self.assertTrue(table[3].endswith("| 1 × |"))

    def test_the_page_of_the_study_has_room_for_the_table(self):
        page = self.folder / "page.md"
        page.write_text((ROOT / "jobs/studies/accuracy.md").read_text())
        accuracy.put_into_page(page, "table")
        self.assertIn(f"{accuracy.BEGIN}\ntable\n{accuracy.END}", page.read_text())

    def test_a_mistake_is_one_sentence_and_an_exit_code(self):
        page = self.folder / "page.md"
        page.write_text("no marks")
        for arguments, code, sentence in (
                ((TINY / "atlas.h5",), 2, "a file of the kind atlas, where accuracy is wanted"),
                ((page,), 3, "not a study that `rubatlas accuracy` has written, or damaged"),
                ((TINY / "accuracy.h5", "--page", page), 2, "no lines <!-- accuracy: begin -->"),
                ((TINY / "accuracy.h5", "--reference", page), 2, "not reference data"),
                ((TINY / "accuracy.h5", "--goal", "nan"), 2, "--goal: nan is no finite number above 0")):
            ended = run(*arguments, "-o", self.folder)
            self.assertEqual(ended.returncode, code)
            self.assertTrue(ended.stderr.startswith("rubatlas-plot accuracy: ") and sentence in ended.stderr,
                            ended.stderr)
            self.assertEqual(ended.stderr.count("\n"), 1, ended.stderr)
        self.assertEqual(page.read_text(), "no marks")


if __name__ == "__main__":
    unittest.main()

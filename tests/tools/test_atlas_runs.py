"""The package runs the program: scenes become atlases, and its commands are called from Python."""
import json
import os
import pathlib
import unittest
import unittest.mock

import h5py
import numpy as np

from package_test import TWO_POINTS, WithFolder

import rubatlas
from rubatlas.program import find_program


class AtlasRuns(WithFolder):
    def test_a_scene_is_written_run_by_several_ranks_analysed_and_opened(self):
        atlas = rubatlas.run(TWO_POINTS, self.folder / "two.h5", ranks=2)
        self.assertEqual((len(atlas), atlas["class"].dims), (2, ("speed_ratio",)))
        self.assertEqual(json.loads((self.folder / "two.json").read_text()), TWO_POINTS)
        before = (self.folder / "two.h5").read_bytes()
        self.assertEqual(len(rubatlas.run(TWO_POINTS, self.folder / "two.h5")), 2)
        self.assertEqual((self.folder / "two.h5").read_bytes(), before)

    def test_a_scene_that_is_refused_does_not_stand_in_the_way_of_the_next(self):
        place = self.folder / "small.h5"
        with self.assertRaises(rubatlas.AtlasError):
            rubatlas.run({"grid": {"sped_ratio": 0.3}}, place)
        self.assertEqual(list(self.folder.iterdir()), [])
        for scene, output, ranks, words in (({"grid": object()}, place, 1, "not one of JSON"),
                                            ({}, self.folder / "no/small.h5", 1, "no folder"),
                                            ({"grid": {"speed_ratio": 0.3}}, place, 0, "at least one")):
            with self.assertRaisesRegex(rubatlas.AtlasError, words):
                rubatlas.run(scene, output, ranks)
        protocol = {"transient_revolutions": 2, "sampled_revolutions": 2}
        self.assertEqual(len(rubatlas.run({"grid": {"speed_ratio": np.array([0.3, 0.4])}, "protocol": protocol},
                                          place)), 2)

    def test_an_atlas_of_another_scene_is_kept(self):
        rubatlas.run(TWO_POINTS, self.folder / "two.h5")
        before = (self.folder / "two.h5").read_bytes()
        for scene_is_there in (True, False):
            with self.assertRaisesRegex(rubatlas.AtlasError, "scene"):
                rubatlas.run({**TWO_POINTS, "grid": {"speed_ratio": [0.3, 0.5]}}, self.folder / "two.h5")
            self.assertEqual((self.folder / "two.h5").read_bytes(), before)
            if scene_is_there:
                (self.folder / "two.json").unlink()
        self.assertEqual(len(rubatlas.run(TWO_POINTS, self.folder / "two.h5")), 2)

    def test_a_wrong_scene_is_answered_with_the_programs_own_sentence(self):
        with self.assertRaisesRegex(rubatlas.AtlasError, "frictoin"):
            rubatlas.run({**TWO_POINTS, "contact": {"frictoin": 0.1}}, self.folder / "two.h5")
        self.assertFalse((self.folder / "two.h5").exists())

    def test_the_program_is_that_of_the_argument_the_environment_the_path_or_the_clone(self):
        kept = dict(os.environ)
        self.addCleanup(lambda: (os.environ.clear(), os.environ.update(kept)))
        program = pathlib.Path(os.environ["RUBATLAS_PROGRAM"])
        (self.folder / "rubatlas").symlink_to(program)
        self.assertEqual(find_program(self.folder / "rubatlas"), self.folder / "rubatlas")
        self.assertEqual(find_program(), program)
        del os.environ["RUBATLAS_PROGRAM"]
        os.environ["PATH"] = f"{self.folder}:{os.environ['PATH']}"
        self.assertEqual(find_program(), self.folder / "rubatlas")
        with self.assertRaisesRegex(rubatlas.AtlasError, "RUBATLAS_PROGRAM.*program=.*PATH.*clone"):
            find_program(self.folder / "none")


class AtlasCommands(WithFolder):
    """Commands of the program, called from Python."""

    def setUp(self):
        super().setUp()
        self.atlas = rubatlas.run(TWO_POINTS, self.folder / "two.h5")

    def test_branches_of_a_scene_and_of_an_atlas_are_followed(self):
        scene = {"grid": {"speed_ratio": {"from": 0.6, "to": 0.65, "count": 3}}}
        from_dict, from_atlas = (
            rubatlas.branch(one, self.folder / f"{name}.h5", from_={"speed_ratio": 0.62}, along="speed_ratio", to=0.625,
                            points=5) for name, one in (("dict", scene), ("atlas", self.atlas)))
        self.assertEqual(from_dict["parameter"][0], 0.62)
        # The orbit at 0.62 is found from motions after different transients.
        np.testing.assert_allclose(from_dict["section"], from_atlas["section"], rtol=1e-9)
        with self.assertRaisesRegex(rubatlas.AtlasError, "dict.h5 .*--overwrite"):
            rubatlas.branch(scene, self.folder / "dict.h5", from_={"speed_ratio": 0.62}, along="speed_ratio")
        with self.assertRaisesRegex(rubatlas.AtlasError, "backward"):
            rubatlas.branch(scene, self.folder / "b.h5", along="speed_ratio", backward=True)

    def test_edges_are_narrowed_down_and_found_beside_the_atlas(self):
        scene = {**TWO_POINTS, "grid": {"speed_ratio": {"from": 0.66, "to": 0.72, "count": 7}},
                 "protocol": {"transient_revolutions": 200, "sampled_revolutions": 50}}
        atlas = rubatlas.run(scene, self.folder / "doubling.h5")
        edges = rubatlas.edges(atlas, to=1e-4)
        self.assertGreater(edges.sizes["edge"], 0)
        self.assertTrue((edges["upper"] - edges["lower"] <= 1e-4).all())
        self.assertTrue(edges.identical(atlas.edges))
        self.assertTrue(edges.identical(rubatlas.edges(self.folder / "doubling.h5", self.folder / "e.h5", to=1e-4)))

    def test_commands_use_the_program_that_an_atlas_was_opened_with(self):
        atlas = rubatlas.open(self.folder / "two.h5", program=os.environ["RUBATLAS_PROGRAM"])
        with unittest.mock.patch.dict(os.environ, {"RUBATLAS_PROGRAM": "/nowhere"}):
            self.assertIn("2 of 2 points have rows", rubatlas.verify(atlas))

    def test_rows_are_verified_and_damage_is_an_error(self):
        self.assertIn("2 of 2 computed again have the same bits", rubatlas.verify(self.atlas, recompute=2))
        with h5py.File(self.folder / "two.h5", "r+") as file:
            file["max_displacement"][..., 0] += 1e-6
        with self.assertRaisesRegex(rubatlas.AtlasError, "speed_ratio"):
            rubatlas.verify(self.folder / "two.h5")

    def test_a_study_of_accuracy_is_run_and_read(self):
        study = rubatlas.accuracy(TWO_POINTS, self.folder / "study.h5", methods=["hybrid", "located"],
                                  tolerances=[1e-6, 1e-8], repeats=1, progress="off")
        self.assertEqual(study.methods(), ["hybrid", "located"])
        self.assertEqual(len(study.of("hybrid")), 2)

    def test_parts_are_merged_into_the_atlas_of_the_whole(self):
        scene = {**TWO_POINTS, "grid": {"speed_ratio": [0.3, 0.4], "damping_ratio": [0.1, 0.2]}}
        whole = rubatlas.run(scene, self.folder / "whole.h5")
        parts = [self.folder / f"part{number}.h5" for number in (1, 2)]
        for number, part in enumerate(parts, 1):
            rubatlas.command("run", self.folder / "whole.json", output=part, part=f"{number}/2", progress="off")
        merged = rubatlas.merge(parts, self.folder / "merged.h5")
        np.testing.assert_array_equal(merged["max_displacement"], whole["max_displacement"])
        half = rubatlas.merge(parts[:1], self.folder / "half.h5")
        np.testing.assert_array_equal(np.isfinite(half["max_displacement"]).sum(), 2)
        with self.assertRaisesRegex(rubatlas.AtlasError, "half.h5 exists"):
            rubatlas.merge(parts[:1], self.folder / "half.h5")

    def test_any_command_is_called_with_its_options_as_keywords(self):
        self.assertIn("period", rubatlas.command("analyse", self.folder / "two.h5", output=self.folder / "m.h5"))
        self.assertIn("speed_ratio", rubatlas.command("explain", self.folder / "two.json", measure=0.05))


if __name__ == "__main__":
    unittest.main()

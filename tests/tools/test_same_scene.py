"""Two files are drawn together only where they belong together."""
import os
import pathlib
import shutil
import sys
import tempfile
import unittest

import h5py

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
TINY = pathlib.Path(os.environ["RUBATLAS_PROGRAM"]).parent / "tests/tiny_atlas"
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tests/support")]
from forked_commands import ended_command  # noqa: E402
from rubatlas import same_scene  # noqa: E402
from rubatlas.atlas_file import AtlasError  # noqa: E402


class ToolsSameScene(unittest.TestCase):
    def expect_refusal(self, tool, sentence, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            ended = ended_command("rubatlas-plot", tool, *arguments, "-o", pathlib.Path(folder) / "a.png")
            self.assertEqual(list(pathlib.Path(folder).iterdir()), [])
        self.assertEqual((ended.returncode, ended.stdout), (2, ""), ended.stderr)
        self.assertRegex(ended.stderr, rf"^rubatlas-plot {tool}: .*{sentence}\n$")

    def test_maps_of_another_atlas_are_refused(self):
        sentence = "rings_maps.h5 was not made from the scene of .*atlas.h5: /grid/.* is .* here and .* there"
        self.expect_refusal("map", sentence, TINY / "atlas.h5", "--maps", TINY / "rings_maps.h5")
        self.expect_refusal("all", sentence, TINY / "atlas.h5", "--maps", TINY / "rings_maps.h5")

    def test_maps_of_the_same_grid_but_another_rotor_are_refused(self):
        for tool, *options in (["map"], ["stack", "--along", "damping_ratio"], ["bifurcation", "--zoom", "0.25:0.5"]):
            self.expect_refusal(tool, "/gravity is there here and absent there", TINY / "gravity.h5", "--maps",
                                TINY / "maps.h5", *options)

    def test_maps_of_fewer_points_than_the_atlas_has_finished_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            maps = pathlib.Path(folder) / "maps.h5"
            shutil.copy(TINY / "maps.h5", maps)
            with h5py.File(maps, "r+") as file:
                file.attrs["points_finished"] -= 1
            for tool, *options in (["map"], ["all"], ["safe_speeds", "--keep", "class<=2"]):
                self.expect_refusal(tool, r"atlas.h5 has \d+ points finished, and .*maps.h5 was made of \d+: `rubatlas "
                                          r"analyse .*` makes it anew", TINY / "atlas.h5", "--maps", maps, *options)

    def test_an_effect_is_compared_with_its_own_absence_only(self):
        self.expect_refusal("effect", "nothing is left out", TINY / "atlas.h5", "--without", TINY / "atlas.h5")
        self.expect_refusal("effect", "nothing is left out", TINY / "atlas.h5", "--without", TINY / "gravity.h5")
        self.expect_refusal("effect", "/grid/~1ring~1radius is absent here and .* there", TINY / "gravity.h5",
                            "--without", TINY / "rings.h5")

    def test_the_title_is_no_part_of_what_must_agree(self):
        one = {"title": "a", "reference": "b", "rotor": {"mass": 1}, "grid": {"speed_ratio": [0.5]}}
        same_scene.require_same("a.h5", one, "b.h5", {**one, "title": "c"})
        with self.assertRaisesRegex(AtlasError, "/rotor/mass is 1 here and 2 there"):
            same_scene.require_same("a.h5", one, "b.h5", {**one, "rotor": {"mass": 2}})

    def test_two_studies_may_have_other_points_of_the_same_rotor(self):
        one = {"rotor": {"mass": 1}, "grid": {"speed_ratio": [0.5]}}
        same_scene.require_same_machine("a.h5", one, "b.h5", {**one, "grid": {"speed_ratio": [0.5, 0.6]}})
        with self.assertRaisesRegex(AtlasError, "/rotor/mass is 1 here and 2 there"):
            same_scene.require_same_machine("a.h5", one, "b.h5", {**one, "rotor": {"mass": 2}})

    def test_an_effect_may_bring_its_axis_and_its_observables(self):
        plain = {"rotor": {"mass": 1}, "grid": {"speed_ratio": [0.5]}, "observables": ["poincare"]}
        worn = {**plain, "wear": {"rate": 1e-7}, "observables": ["poincare", "clearance_growth"],
                "grid": {"speed_ratio": [0.5], "/wear/rate": [1e-7, 1e-6]}}
        same_scene.require_without_effect("a.h5", worn, "b.h5", plain)
        with self.assertRaisesRegex(AtlasError, "/grid/speed_ratio"):
            same_scene.require_without_effect("a.h5", worn, "b.h5", {**plain, "grid": {"speed_ratio": [0.6]}})


if __name__ == "__main__":
    unittest.main()

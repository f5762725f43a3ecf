"""Periodic orbits followed along a quantity: what the file holds, where branches end, and what is refused."""
import unittest

import h5py
import numpy as np

from job import JobTest

ROTOR = {"title": "branch", "reference": "none", "grid": {"speed_ratio": 0.5}}


class Branch(JobTest):
    def branch(self, *options, changes=None, code=0):
        scene = self.write_scene({**ROTOR, **(changes or {})})
        job = self.execute(None, "branch", scene, *options, "-o", "branch.h5", "--overwrite")
        self.assertEqual(job.returncode, code, job.stderr)
        return job.stderr

    def rows(self):
        with h5py.File(self.directory / "branch.h5", "r") as file:
            names = []
            file.visit(names.append)
            return {name: file[name][()] for name in names if isinstance(file[name], h5py.Dataset)}

    def test_both_ends_of_region_two_graze_on_the_receding_side(self):
        for start, end in ((0.42, 0.4393376950), (0.62, 0.5954369945)):
            said = self.branch("--from", f"speed_ratio={start}", "--along", "speed_ratio", "--to",
                               str(0.46 if end > start else 0.55))
            found = self.rows()
            self.assertIn("on the receding side", said)
            self.assertEqual(list(found["events/kind"]), [4])
            self.assertEqual(list(found["events/grazing_side"]), [3])
            self.assertAlmostEqual(found["events/parameter"][0], end, delta=1e-8)
            self.assertLess(found["events/uncertainty"][0], 1e-8)

    def test_region_four_begins_with_a_period_doubling_at_which_the_branch_can_be_switched(self):
        self.branch("--from", "speed_ratio=0.67", "--along", "speed_ratio", "--to", "0.70", "--switch")
        found = self.rows()
        doubling = found["events/kind"] == 2
        self.assertAlmostEqual(found["events/parameter"][doubling][0], 0.6840370978, delta=1e-8)
        largest = np.hypot(*found["events/multipliers"][doubling][0, 0])
        self.assertAlmostEqual(largest, 1.0, delta=1e-6)
        self.assertEqual(set(found["period"][found["branch"] == 0]), {1})
        self.assertEqual(set(found["period"][found["branch"] == 1]), {2})
        at = found["parameter"][found["branch"] == 0]
        stable = found["stability"][found["branch"] == 0] == 1
        self.assertTrue((stable == (at < 0.6840370978)).all(), "the orbit loses its stability there")

    def test_a_file_of_the_same_scene_has_the_same_bytes(self):
        options = ("--from", "speed_ratio=0.42", "--along", "damping_ratio", "--to", "0.12")
        self.branch(*options)
        first = (self.directory / "branch.h5").read_bytes()
        self.branch(*options)
        self.assertEqual((self.directory / "branch.h5").read_bytes(), first)
        self.assertTrue(((0.1 - 1e-12 <= self.rows()["parameter"]) & (self.rows()["parameter"] <= 0.12 + 1e-12)).all())

    def test_a_wrong_call_is_refused_in_one_sentence(self):
        start = ("--from", "speed_ratio=0.42")
        for options, changes, sentence in (
                ((*start, "--along", "sped_ratio"), {}, "--along sped_ratio: no quantity of the scene's grid"),
                ((*start, "--along", "speed_ratio", "--to", "0"), {}, "--to 0: speed_ratio is a number in"),
                ((*start, "--along", "speed_ratio", "--to", "0.42"), {}, "--to 0.42: that is where the branch starts"),
                ((*start, "--along", "speed_ratio", "--curve", "fold"), {}, "--curve and --in belong together"),
                (("--from", "speed_ratio=0.5", "--along", "speed_ratio"), {}, "does not settle on a periodic orbit"),
                ((*start, "--along", "speed_ratio"), {"wear": {"rate": 1e-9}}, "/wear: the motion under this effect"),
                ((*start, "--along", "speed_ratio"), {"accuracy": {"method": "fixed"}}, "/accuracy/method: its steps")):
            with self.subTest(sentence=sentence):
                said = self.branch(*options, changes=changes, code=2)
                self.assertIn(sentence, said)
                self.assertEqual(said.count("\n"), 1)


if __name__ == "__main__":
    unittest.main()

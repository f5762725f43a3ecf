"""Periodic orbits followed along a quantity: what the file holds, where branches end, and what is refused."""
import os
import pty
import signal
import subprocess
import unittest

import h5py
import numpy as np

from job import JobTest, command

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

    def grazings(self):
        found = self.rows()
        at = found["events/kind"] == 4
        self.assertEqual(set(found["events/grazing_side"][at]), {3}, "the receding side")
        self.assertLess(max(found["events/uncertainty"][at]), 1e-7)
        return list(found["events/parameter"][at])

    def test_region_two_lies_between_two_grazings_and_one_branch_of_unstable_orbits_leads_from_one_to_the_other(self):
        said = self.branch("--from", "speed_ratio=0.42", "--along", "speed_ratio", "--to", "0.46")
        self.assertIn("on the receding side", said)
        first, = self.grazings()
        self.assertAlmostEqual(first, 0.439338032, delta=1e-8)
        found = self.rows()
        self.assertEqual(found["parameter"][-1], 0.46)
        self.assertTrue(((found["stability"] == 1) == (found["parameter"] <= first)).all(),
                        "unstable behind the grazing")
        self.branch("--from", "speed_ratio=0.62", "--along", "speed_ratio", "--to", "0.43")
        last, again = self.grazings()
        self.assertAlmostEqual(last, 0.595436672, delta=1e-8)
        self.assertAlmostEqual(again, first, delta=1e-8, msg="the same grazing, from where the contact vanishes")
        found = self.rows()
        self.assertEqual(found["admissible"].min(), 1)
        self.assertEqual(found["parameter"][-1], 0.43)
        self.assertEqual(found["stability"][-1], 1)

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

    def test_one_that_is_interrupted_keeps_its_orbits_and_says_on_a_terminal_how_far_it_is(self):
        scene = self.write_scene({**ROTOR, "blades": {"count": 2}})
        ours, terminal = pty.openpty()
        program = command(None, "branch", scene, "--from", "speed_ratio=0.6", "--along", "speed_ratio", "--to", "0.72",
                          "-o", "branch.h5")
        job = subprocess.Popen(program, cwd=self.directory, stderr=terminal)
        os.close(terminal)
        said = b""
        while b"orbits, period 14, speed_ratio = 0.6" not in said:
            said += os.read(ours, 1024)
        job.send_signal(signal.SIGINT)
        try:
            while more := os.read(ours, 1024):
                said += more
        except OSError:  # nobody writes to it any more
            pass
        os.close(ours)
        self.assertEqual(job.wait(), 75)
        said = said.decode()
        self.assertRegex(said, r"stopped after \d+ orbits at speed_ratio = 0\.\d+, before --to 0\.72\r\n")
        orbits = len(self.rows()["parameter"])
        self.assertIn(f"\nrubatlas: {orbits} periodic orbits in branch.h5", said)

    def test_a_file_of_the_same_scene_has_the_same_bytes(self):
        options = ("--from", "speed_ratio=0.42", "--along", "damping_ratio", "--to", "0.12")
        self.branch(*options)
        first = (self.directory / "branch.h5").read_bytes()
        self.branch(*options)
        self.assertEqual((self.directory / "branch.h5").read_bytes(), first)
        self.assertTrue(((0.1 - 1e-12 <= self.rows()["parameter"]) & (self.rows()["parameter"] <= 0.12 + 1e-12)).all())

    def test_a_branch_that_begins_next_to_zero_takes_steps_of_how_far_it_goes(self):
        counts = []
        for unbalance in "0", "1e-6":
            start = f"speed_ratio=0.62,unbalance={unbalance}"
            self.branch("--from", start, "--along", "unbalance", "--to", "1e-5",
                        changes={"grid": {"speed_ratio": 0.62, "unbalance": [0, 1e-6]}})
            found = self.rows()["parameter"]
            self.assertAlmostEqual(found[-1], 1e-5, delta=1e-15)
            counts.append(len(found))
        self.assertLess(counts[1], 1.5 * counts[0])

    def test_a_branch_that_the_number_of_points_ends_says_where_it_stopped(self):
        options = ("--from", "speed_ratio=0.42", "--along", "speed_ratio", "--to", "0.43")
        said = self.branch(*options, "--points", "5")
        self.assertRegex(said, r"rubatlas: stopped after 5 orbits at speed_ratio = 0\.42\d*, before --to 0\.43; a ")
        self.assertEqual(self.goes_on(), 1)
        with h5py.File(self.directory / "branch.h5", "r") as file:
            self.assertEqual((file.attrs["damping_ratio"], file.attrs["friction"]), (0.1, 0.1))
            self.assertNotIn("speed_ratio", file.attrs, "it varies")
        self.assertNotIn("stopped", self.branch(*options))
        self.assertEqual(self.goes_on(), 0)
        said = self.branch(*options, "--both", "--points", "5")
        self.assertEqual(said.count("before an end of 0.41 to 0.43; a larger --points"), 2)

    def test_a_curve_ends_at_the_limits_of_its_second_quantity(self):
        said = self.branch("--from", "speed_ratio=0.66", "--along", "speed_ratio", "--to", "0.70", "--curve",
                           "period_doubling", "--in", "damping_ratio", "--within", "0.098", "0.104")
        self.assertNotRegex(said, "stopped|lost")
        found = self.rows()
        damping, speed = found["second_parameter"], found["parameter"]
        self.assertTrue(np.allclose(damping[[0, -1]], (0.098, 0.104), rtol=1e-14, atol=0.0), damping)
        self.assertAlmostEqual(np.interp(0.1, damping, speed), 0.6840370978, delta=1e-8)

    def goes_on(self):
        with h5py.File(self.directory / "branch.h5", "r") as file:
            return file.attrs["goes_on"]

    def test_a_curve_that_cannot_be_followed_is_refused_before_anything_is_computed(self):
        # From here nothing could be followed: the motion does not settle.
        start = ("--from", "speed_ratio=0.5", "--along", "speed_ratio")
        curve = (*start, "--curve", "fold", "--in", "damping_ratio")
        for options, sentence in (
                ((*start, "--in", "damping_ratio"), "--curve and --in belong together"),
                ((*start, "--within", "0.1", "0.2"), "--within: limits of a curve's second quantity"),
                ((*start, "--curve", "grazing", "--in", "damping_ratio"), "--curve grazing: allowed: fold, "),
                ((*start, "--curve", "fold", "--in", "dampng_ratio"), "--in dampng_ratio: no quantity of the scene's"),
                ((*start, "--curve", "fold", "--in", "speed_ratio"), "--in: the same quantity as --along"),
                ((*curve, "--within", "0.2", "0.05"), "--within 0.2 0.05: the lower limit comes first"),
                ((*curve, "--within", "-0.2", "0.2"), "--within -0.2: damping_ratio is a number in"),
                ((*curve, "--within", "0.2", "0.3"), "--within 0.2 0.3: the curve starts at damping_ratio = 0.1, ")):
            with self.subTest(sentence=sentence):
                said = self.branch(*options, code=2)
                self.assertIn(sentence, said)
                self.assertEqual(said.count("\n"), 1)

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

"""jobs/rig.py on small scenes: its tables say what the atlases hold, its pictures are drawn."""
import importlib.util
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import h5py
import matplotlib.image
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))

from mpi_environment import CROWDED  # noqa: E402

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
SHORT = {"transient_revolutions": 60, "sampled_revolutions": 40, "samples_per_revolution": 64}


def script():
    """jobs/rig.py as a module."""
    found = importlib.util.spec_from_file_location("rig_script", ROOT / "jobs/rig.py")
    module = importlib.util.module_from_spec(found)
    found.loader.exec_module(module)
    return module


def scene(name, grid, **other):
    """A scene of jobs with a grid of one's own."""
    return {**json.loads((ROOT / f"jobs/{name}.json").read_text()), "grid": grid, **other}


class Rig(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.script = script()

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def written(self, name, content):
        path = self.folder / f"{name}.json"
        path.write_text(json.dumps(content))
        return path

    def printed(self, *arguments):
        """What the script prints, which is also the table that it writes."""
        ended = subprocess.run([ROOT / "jobs/rig.py", *map(str, arguments), "--ranks", "1", "--into", self.folder,
                                "--pictures", self.folder], env=CROWDED, capture_output=True, text=True, check=False)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertEqual((self.folder / f"rig_{arguments[0]}.md").read_text(), ended.stdout)
        return ended.stdout

    def expect_drawn(self, name):
        """A picture of which much is neither white nor all of one colour."""
        pixels = matplotlib.image.imread(self.folder / name)[:, :, :3]
        self.assertGreater(len(np.unique(pixels.reshape(-1, 3), axis=0)), 200)
        self.assertGreater(np.mean(pixels.min(axis=2) < 0.9), 0.1)

    def test_probes_read_the_hub_over_their_lever_until_they_saturate(self):
        hub = np.array([0.0, 1.1e-3, -1.1e-3, 1.584e-3, 1.6e-3, -5e-3])
        np.testing.assert_allclose(self.script.probe(hub), [0.0, 0.5e-3, -0.5e-3, 0.72e-3, 0.72e-3, -0.72e-3],
                                   rtol=1e-12)

    def test_points_of_one_held_speed_belong_together(self):
        speed = np.array([0.1, 0.2, 0.2 * (1 + 1e-8), 0.2 * (1 + 2e-8), 0.3])
        self.assertEqual(self.script.held(speed), [slice(0, 1), slice(1, 4), slice(4, 5)])

    def test_each_speed_of_the_measured_rig_is_held_for_20_seconds(self):
        content = json.loads((ROOT / "jobs/rig_measured.json").read_text())
        speed = np.array(content["grid"]["speed_ratio"])
        rpm = speed * content["rotor"]["natural_frequency"] * 30.0 / np.pi
        revolutions = content["protocol"]["sampled_revolutions"]
        self.assertEqual(content["protocol"]["transient_revolutions"], 0)
        parts = self.script.held(speed)
        np.testing.assert_allclose([rpm[part][0] for part in parts], np.arange(250, 1501, 10), rtol=1e-9)
        for part in parts:
            held = sum(60.0 / rpm[part]) * revolutions  # [s]
            self.assertLessEqual(abs(held - 20.0), 0.5 * 60.0 / rpm[part][0] * revolutions)

    def test_a_motion_that_wears_on_repeats_itself_and_an_aperiodic_one_does_not(self):
        turn = np.arange(60)[:, np.newaxis]
        alternating = np.array([1e-3, 2e-3, 0.0, 0.0]) * (-1.0) ** turn
        self.assertTrue(self.script.repeats(alternating * (1.0 + 1e-4 * turn)))
        self.assertTrue(self.script.repeats(alternating * (1.0 + np.exp(-turn))))  # it approaches in the first half
        self.assertFalse(self.script.repeats(alternating * np.cos(turn)))

    def test_a_statement_that_holds_on_few_rigs_is_counted_finding_by_finding(self):
        def rig(of_p10, of_p14c):
            found = {name: [self.script.rig.Finding(True, "", "all")] for name in self.script.STATEMENTS}
            found["P10"] = [self.script.rig.Finding(of_p10, "", "an orbit")]
            found["P14c"] = [self.script.rig.Finding(holds, "", claim) for holds, claim in of_p14c]
            return {}, {name: all(one.holds is True for one in parts) for name, parts in found.items()}, found
        parts = self.script.parts_of([rig(True, [(True, "first"), (False, "last")]),
                                      rig(True, [(False, "first"), (None, "last")]),
                                      rig(False, [(True, "first"), (False, "last")])])
        some = {words: parts[words] for words in ("P10 four orbits", "P14c first", "P14c last")}
        np.testing.assert_array_equal(self.script.together(some), [[2, 1, 0], [1, 2, 0], [0, 0, 0]])

    def test_the_rigs_of_a_small_grid_are_judged_counted_and_drawn(self):
        path = self.written("few", scene("rig_unknowns", {
            "speed_ratio": {"from": 0.15, "to": 0.8, "count": 66}, "friction": [0.2], "unbalance": [0, 3e-5],
            "/unbalance/phase": [0, 1.0], "/blades/youngs_modulus": [412e9], "/blades/length": [0.04],
            "/unequal_blades/length_spread": [0]}, protocol=SHORT))
        table = self.printed("unknowns", "--scene", path)
        self.assertIn("3 rigs.", table)  # of 4 lines two are the rig without unbalance
        with h5py.File(self.folder / "few_maps.h5") as maps:
            speed = maps["speed_ratio"][...]
            motion = maps["class"][...].reshape(-1, speed.size)  # by phase, and unbalance
        for place, aperiodic in ((0.304, False), (0.4, True), (0.605, False), (0.74, True)):
            near = (speed >= place - 0.005) & (speed <= place + 0.005)
            known = [line[near & (line != 254)] for line in motion[[0, 1, 3]]]  # 254: unresolved
            expected = sum(one.size > 0 and (np.mean(one == 255) >= 0.5) == aperiodic for one in known)
            words = f"{'aperiodic' if aperiodic else 'periodic'} at {place:.3f}"
            self.assertRegex(table, re.escape(f"| {words} | {expected} | "))
        self.expect_drawn("rig_unknowns.png")

    def test_the_measured_rig_is_drawn_beside_the_one_at_constant_speed(self):
        places = [0.2, 0.45, 0.56, 0.6, 0.75]
        held = [place * (1.0 + 1e-8 * batch) for place in places for batch in range(2)]
        measured = self.written("raised", scene("rig_measured", {
            "speed_ratio": held, "unbalance": [5e-6, 2e-5], "/unbalance/phase": [0, 1.0]}, protocol={
                **SHORT, "transient_revolutions": 0}))
        beside = self.written("constant", scene("rig", {"speed_ratio": places, "friction": [0.2]}, protocol=SHORT,
                                                observables=["poincare", "max_displacement", "spectrum"]))
        table = self.printed("measured", "--scene", measured, "--beside", beside)
        with h5py.File(self.folder / "raised.h5") as atlas:
            largest = 1e3 * atlas["max_displacement"][...].reshape(2, 2, len(places), 2)[0, 1].max(axis=1)
            worn = 1e3 * atlas["final_state_wear"][...].reshape(2, 2, 2 * len(places), 3)[:, :, -1].max(axis=-1)
        rows = [line for line in table.splitlines() if line.startswith(("| region", "| chaos", "| rest"))]
        self.assertEqual(len(rows), len(places))
        for row, place, value in zip(rows, places, largest):
            self.assertTrue(row.endswith(f"{value:.3f} to {value:.3f}, {value:.3f} at {place:.3f} |"), row)
        for phase, degrees in enumerate((0, 57)):
            for unbalance, name in enumerate(("5e-06", "2e-05")):
                self.assertRegex(table, rf"\| {name} \| {degrees} \| .* \| {worn[phase, unbalance]:.2f} \|")
        self.expect_drawn("rig_measured.png")


if __name__ == "__main__":
    unittest.main()

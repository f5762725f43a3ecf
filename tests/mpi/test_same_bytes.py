"""One scene, one atlas: whatever the number of ranks, to the last bit."""
import json
import unittest

import h5py
import numpy as np

from job import DONE, FAILING, JobTest, LEFT_VALIDITY, long_scene, scene


class SameBytes(JobTest):
    def compare(self, content, numbers=(2, 5)):
        """With no master, one worker or four."""
        alone = self.fill(None, content, "alone.h5")
        for ranks in numbers:
            self.assert_same_bytes(alone, self.fill(ranks, content, f"ranks{ranks}.h5"))
        with h5py.File(alone, "r") as atlas:
            return {name: atlas[name][...] for name in ("status", "restarted", "final_state", "max_displacement")}

    def test_a_sweep_up_has_the_same_bytes_for_any_number_of_ranks(self):
        rows = self.compare(scene(sweep="up"), (1, 2, 3, 5))
        self.assertTrue((rows["status"] == DONE).all())
        self.assertTrue((rows["restarted"][..., 0] == 1).all(), "the lowest speed starts from `initial`")

    def test_a_sweep_down_has_the_same_bytes_for_any_number_of_ranks(self):
        rows = self.compare(scene(sweep="down"))
        self.assertTrue((rows["restarted"][..., -1] == 1).all(), "the highest speed starts from `initial`")

    def test_a_sweep_both_ways_has_the_same_bytes_for_any_number_of_ranks(self):
        rows = self.compare(scene(sweep="both"))
        self.assertEqual(rows["status"].shape, (2, 1, 1, 1, 3, 12))
        self.assertTrue((rows["restarted"][0, ..., 0] == 1).all() and (rows["restarted"][1, ..., -1] == 1).all())

    def test_independent_points_have_the_same_bytes_for_any_number_of_ranks(self):
        rows = self.compare(scene(sweep="independent"))
        self.assertTrue((rows["restarted"] == 1).all(), "every point starts from `initial`")

    def test_lines_with_points_that_fail_have_the_same_bytes_for_any_number_of_ranks(self):
        content = scene()
        content["grid"]["damping_ratio"] = FAILING
        rows = self.compare(content)
        self.assertTrue((rows["status"] == DONE).any() and (rows["status"] == LEFT_VALIDITY).any())

    def test_the_elastic_ring_has_the_same_bytes_for_any_number_of_ranks(self):
        self.compare(scene(contact={"law": "elastic_ring", "friction": 0.1}))

    def test_each_line_of_both_ways_is_the_line_of_that_way(self):
        both, up, down = (self.fill(None, scene(sweep=way), f"{way}.h5") for way in ("both", "up", "down"))
        with h5py.File(both, "r") as b, h5py.File(up, "r") as u, h5py.File(down, "r") as d:
            for name in ("status", "poincare", "spectrum"):
                np.testing.assert_array_equal(b[name][0], u[name][...])
                np.testing.assert_array_equal(b[name][1], d[name][...])

    def test_a_point_behind_one_that_failed_starts_from_initial(self):
        # Near 1.05 the shaft always leaves; what follows must not start from there.
        content = scene(grid={"speed_ratio": [0.5, 0.6, 1.1, 1.15, 1.65], "damping_ratio": 0.1})
        atlas = self.fill(2, content)
        with h5py.File(atlas, "r") as file:
            status, restarted = file["status"][...].ravel(), file["restarted"][...].ravel()
        self.assertIn(LEFT_VALIDITY, status)
        self.assertEqual(list(restarted[1:]), [int(before != DONE) for before in status[:-1]])

    def test_both_ranks_have_worked(self):
        atlas = self.fill(2, long_scene())
        run = json.loads((self.directory / (atlas.name + ".run.json")).read_text())["runs"][0]
        self.assertEqual(sum(run["points_of_rank"]), 180)
        for points in run["points_of_rank"]:
            self.assertGreater(points, 45)


if __name__ == "__main__":
    unittest.main()

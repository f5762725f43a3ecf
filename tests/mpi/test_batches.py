"""Lines side by side in SIMD lanes or one after the other: the same atlas, to the last bit."""
import json
import unittest

import h5py

import job
from job import DONE, JobTest, scene


class Batches(JobTest):
    def fill_by_line(self, content, name="by_line.h5"):
        job.ENVIRONMENT["RUBATLAS_LANES"] = "1"
        try:
            return self.fill(None, content, name)
        finally:
            del job.ENVIRONMENT["RUBATLAS_LANES"]

    def record(self, atlas):
        return json.loads((self.directory / (atlas.name + ".run.json")).read_text())["runs"][0]

    def compare(self, content):
        by_line = self.fill_by_line(content)
        self.assertEqual(self.record(by_line)["lanes_of_rank"], [1])
        self.assertEqual(self.record(by_line)["attempts_in_lanes_of_rank"], [0])
        for ranks in (None, 1, 2, 3):
            batched = self.fill(ranks, content, f"batched{ranks}.h5")
            self.assert_same_bytes(by_line, batched)
            record = self.record(batched)
            self.assertEqual(len(record["lanes_of_rank"]), ranks or 1)
            if record["lanes_of_rank"][0] > 1:
                self.assertGreater(sum(record["attempts_in_lanes_of_rank"]), 0)
        return by_line

    def test_eight_damping_ratios_have_the_same_bytes_side_by_side_and_line_by_line(self):
        content = scene(sweep="up")
        content["grid"]["damping_ratio"] = [0.02, 0.04, 0.06, 0.08, 0.1, 0.15, 0.2, 0.3]
        with h5py.File(self.compare(content), "r") as atlas:
            status = atlas["status"][...]
        self.assertTrue((status == DONE).any() and (status != DONE).any(), "points that fail hurt nobody")

    def test_lines_with_and_without_unbalance_have_the_same_bytes(self):
        content = scene(sweep="both")
        content["grid"]["unbalance"] = [0.0, 1e-5, 1e-4]
        self.compare(content)

    def test_independent_points_have_the_same_bytes(self):
        self.compare(scene(sweep="independent"))

    def test_one_line_alone_makes_no_batches(self):
        content = scene(sweep="up")
        content["grid"]["damping_ratio"] = 0.1
        self.assertEqual(self.record(self.fill(None, content))["attempts_in_lanes_of_rank"], [0])

    def test_two_ranks_share_the_lines(self):
        content = scene(sweep="up")
        content["grid"]["damping_ratio"] = [0.1, 0.12, 0.14, 0.16, 0.18, 0.2]
        content["grid"]["speed_ratio"]["count"] = 60
        record = self.record(self.fill(2, content))
        # How many each computes is a matter of their speed; that each gets half of the lines to begin with is not.
        self.assertGreater(min(record["points_of_rank"]), 0)
        if min(record["lanes_of_rank"]) > 1:
            self.assertGreater(min(record["attempts_in_lanes_of_rank"]), 0)

    def test_a_number_of_lanes_that_there_is_not_is_refused(self):
        run = self.execute(None, "run", self.write_scene(scene()), "-o", "atlas.h5", "--lanes", "-1")
        self.assert_refused(run, 2, "--lanes -1", "side by side")


if __name__ == "__main__":
    unittest.main()

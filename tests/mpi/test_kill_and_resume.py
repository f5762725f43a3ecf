"""A rank that is killed, at any moment, costs the points that were under way, and nothing else."""
import os
import random
import shutil
import signal
import unittest

import h5py
import numpy as np

from atlas_contract import computed_checksum
from job import DONE, JobTest, PENDING, long_scene, ranks_of, wait_for_points


class KillAndResume(JobTest):
    def kill_and_resume(self, content, trials):
        whole = self.whole(content)
        total = h5py.File(whole, "r")["status"].size
        interrupted = 0
        for seed, ranks in trials:
            chance = random.Random(seed)
            with self.subTest(seed=seed, ranks=ranks):
                atlas = self.directory / f"killed{seed}.h5"
                job = self.start(ranks, content, atlas)
                wait_for_points(job, atlas, chance.randrange(1, total // 2))
                victims = ranks_of(job)
                if victims:
                    os.kill(chance.choice(victims), signal.SIGKILL)
                self.assertNotIn(job.wait(timeout=60), (0, 10) if victims else (), "mpirun ends the job")
                if atlas.exists():
                    interrupted += 0 < self.assert_no_wrong_row(atlas, whole) < total
                resumed = self.fill(ranks, content, atlas.name, "--resume")
                self.assert_same_bytes(whole, resumed)
        self.assertGreater(interrupted, len(trials) // 2, "most kills hit a job at work")

    def test_a_killed_rank_of_a_sweep_leaves_an_atlas_that_resumes_to_the_same_bytes(self):
        self.kill_and_resume(long_scene(), [(1, 2), (5, 5)])

    def test_a_killed_rank_of_independent_points_leaves_an_atlas_that_resumes_to_the_same_bytes(self):
        self.kill_and_resume(long_scene(sweep="independent"), [(11, 2), (12, 3)])

    def test_a_killed_process_without_mpirun_leaves_an_atlas_that_resumes_to_the_same_bytes(self):
        whole = self.whole(long_scene())
        for count in (1, 120):
            with self.subTest(count=count):
                atlas = self.directory / f"killed{count}.h5"
                job = self.start(None, long_scene(), atlas)
                wait_for_points(job, atlas, count)
                job.kill()
                job.wait()
                self.assertGreaterEqual(self.assert_no_wrong_row(atlas, whole), count)
                self.assert_same_bytes(whole, self.fill(2, long_scene(), atlas.name, "--resume"))

    def test_a_resumed_job_computes_pending_points_only_and_goes_on_from_stored_states(self):
        whole = self.whole(long_scene())
        marked = self.directory / "marked.h5"
        shutil.copy(whole, marked)
        with h5py.File(marked, "r+") as file:
            status = file["status"][...]
            line = np.flatnonzero((status == DONE).reshape(3, 60).all(axis=1))[-1]
            # A hole in the middle of a line that has no failures, and a mark on a point that must not be touched.
            hole, kept = (0, 0, 0, line, slice(20, 25)), (0, 0, 0, line, 40)
            status[hole] = PENDING
            file["status"][...] = status
            file["poincare"][hole] = 0.0
            file["final_state"][hole] = 0.0
            value = file["max_displacement"][kept]
            file["max_displacement"][kept] = -1.0
            file["row_checksum"][kept] = computed_checksum(file, kept)
        self.fill(2, long_scene(), marked.name, "--resume")
        with h5py.File(marked, "r+") as file:
            self.assertEqual(file["max_displacement"][kept], -1.0)
            file["max_displacement"][kept] = value
            file["row_checksum"][kept] = computed_checksum(file, kept)
        self.assertEqual(h5py.File(marked, "r")["poincare"][...].tobytes(),
                         h5py.File(whole, "r")["poincare"][...].tobytes())
        self.assert_no_wrong_row(marked, whole)


if __name__ == "__main__":
    unittest.main()

"""A job that is asked to stop finishes its points, says 75, and goes on later to the same bytes."""
import json
import signal
import unittest

from job import JobTest, long_scene, wait_for_points


class Stop(JobTest):
    def stop(self, ranks, which, name, expected=75):
        atlas = self.directory / name
        job = self.start(ranks, long_scene(), atlas)
        wait_for_points(job, atlas, 20)
        job.send_signal(which)
        code = job.wait(timeout=60)
        if expected is not None:
            self.assertEqual(code, expected)
        return atlas

    def runs(self, atlas):
        return json.loads((self.directory / (atlas.name + ".run.json")).read_text())["runs"]

    def check_resumable(self, atlas):
        whole = self.fill(None, long_scene(), "whole.h5")
        self.assertFalse(whole.read_bytes() == atlas.read_bytes(), "the job ended before it was stopped")
        self.assert_same_bytes(whole, self.fill(2, long_scene(), atlas.name, "--resume"))

    def test_usr1_to_mpirun_ends_with_75_and_resumes_to_the_same_bytes(self):
        atlas = self.stop(2, signal.SIGUSR1, "stopped.h5")
        self.check_resumable(atlas)
        first, second = self.runs(atlas)
        self.assertEqual([first["exit_code"], first["resumed"], second["resumed"]], [75, False, True])
        self.assertEqual(first["points_computed"] + second["points_computed"], 180, "no point was computed twice")

    def test_usr1_to_five_ranks_ends_with_75(self):
        self.check_resumable(self.stop(5, signal.SIGUSR1, "stopped.h5"))

    def test_usr1_without_mpirun_ends_with_75(self):
        self.check_resumable(self.stop(None, signal.SIGUSR1, "stopped.h5"))

    def test_terminate_and_interrupt_without_mpirun_end_with_75(self):
        self.stop(None, signal.SIGTERM, "terminated.h5")
        self.check_resumable(self.stop(None, signal.SIGINT, "interrupted.h5"))

    def test_terminate_to_mpirun_leaves_a_resumable_atlas(self):
        # The exit code is mpirun's own.
        self.check_resumable(self.stop(2, signal.SIGTERM, "terminated.h5", expected=None))


if __name__ == "__main__":
    unittest.main()

"""A job that is asked to stop gives up its points, says 75 and how to go on, and goes on later to the same bytes."""
import json
import os
import re
import signal
import subprocess
import unittest

import h5py

from job import (ENVIRONMENT, JobTest, OPEN_MPI, PENDING, has_ended, long_scene, pauses, scene, wait_for,
                 wait_for_points)


def endless_scene():
    """Two points of hours each."""
    content = scene(protocol={"transient_revolutions": 100000000, "sampled_revolutions": 1,
                              "samples_per_revolution": 32, "settle": "never"},
                    sweep="independent")
    content["grid"] = {"speed_ratio": [0.3, 0.62]}
    return content


class Stop(JobTest):
    def stop(self, ranks, which, name, expected=75, content=None):
        atlas = self.directory / name
        job = self.start(ranks, content or long_scene(), atlas)
        wait_for_points(job, atlas, 5)
        job.send_signal(which)
        code = job.wait(timeout=60)
        if expected is not None:
            self.assertEqual(code, expected)
        self.said = job.stderr.read()
        return atlas

    def runs(self, atlas):
        return json.loads((self.directory / (atlas.name + ".run.json")).read_text())["runs"]

    def check_resumable(self, atlas, content=None):
        content = content or long_scene()
        whole = self.whole(content)
        self.assertFalse(whole.read_bytes() == atlas.read_bytes(), "the job ended before it was stopped")
        self.assert_same_bytes(whole, self.fill(2, content, atlas.name, "--resume"))

    def test_usr1_to_mpirun_ends_with_75_and_resumes_to_the_same_bytes(self):
        atlas = self.stop(2, signal.SIGUSR1, "stopped.h5")
        self.check_resumable(atlas)
        first, second = self.runs(atlas)
        self.assertEqual([first["exit_code"], first["resumed"], second["resumed"]], [75, False, True])
        self.assertEqual(first["points_computed"] + second["points_computed"], 180, "no point was computed twice")

    def test_usr1_to_five_ranks_ends_with_75(self):
        self.check_resumable(self.stop(5, signal.SIGUSR1, "stopped.h5"))

    def test_terminate_interrupt_and_hang_up_without_mpirun_end_with_75(self):
        self.stop(None, signal.SIGTERM, "terminated.h5")
        self.stop(None, signal.SIGHUP, "hung_up.h5")
        self.check_resumable(self.stop(None, signal.SIGINT, "interrupted.h5"))

    def test_terminate_to_mpirun_leaves_a_resumable_atlas_and_a_record(self):
        # mpirun passes the signal on when it likes, a second later on some machines.
        content = long_scene(transient_revolutions=1500)
        # The exit code is mpirun's own, and none of ours that means an end.
        atlas = self.stop(2, signal.SIGTERM, "terminated.h5", expected=None, content=content)
        state = self.execute(None, "status", atlas)
        self.assertEqual(state.returncode, 75, state.stdout)
        self.assertRegex(state.stdout, r"terminated\.h5: \d+ of 180 points: .* 0 failed; \d+ pending")
        run, = self.runs(atlas)
        self.assertEqual((run["ranks"], run["points_total"]), (2, 180))
        if OPEN_MPI < 5:  # which shows nothing of what its ranks still say
            self.assertIn("; to go on: ", self.said)
        # To which bytes other tests look at, of shorter motions.
        self.fill(2, content, atlas.name, "--resume")
        first, second = self.runs(atlas)
        self.assertEqual((second["exit_code"], second["resumed"]), (0, True))
        self.assertEqual(first["points_computed"] + second["points_computed"], 180, "no point was computed twice")

    def test_the_command_that_a_stopped_job_names_goes_on_with_it(self):
        for ranks in (None, 2):
            with self.subTest(ranks=ranks):
                self.stop(ranks, signal.SIGUSR1, "stopped here.h5")
                named, = re.findall(r"^rubatlas: stopping.*; to go on: (.*)$", self.said, re.MULTILINE)
                self.assertEqual(named.startswith("mpirun -n 2 "), ranks == 2)
                again = subprocess.run(named.replace("mpirun ", "mpirun --oversubscribe ", 1), shell=True,
                                       cwd=self.directory,
                                       env=ENVIRONMENT, capture_output=True, text=True, timeout=60, check=False)
                self.assertEqual(again.returncode, 0, again.stderr)
                with h5py.File(self.directory / "stopped here.h5") as file:
                    self.assertTrue((file["status"][...] != PENDING).all())
                (self.directory / "stopped here.h5").unlink()

    def test_a_point_of_hours_is_given_up_and_stays_pending(self):
        for ranks in (None, 2):
            with self.subTest(ranks=ranks):
                atlas = self.directory / f"endless{ranks}.h5"
                job = self.start(ranks, endless_scene(), atlas)
                self.assertTrue(wait_for(lambda: atlas.with_name(atlas.name + ".run.json").exists()))
                self.wait_until_it_computes(job, ranks)
                job.send_signal(signal.SIGUSR1)
                self.assertEqual(job.wait(timeout=60), 75, job.stderr.read())
                with h5py.File(atlas) as file:
                    self.assertTrue((file["status"][...] == PENDING).all())
                self.assertEqual([run["exit_code"] for run in self.runs(atlas)], [75])

    def test_a_second_signal_ends_a_rank_that_waits_for_another_at_once(self):
        atlas = self.directory / "atlas.h5"
        job = self.start(2, endless_scene(), atlas)
        self.assertTrue(wait_for(lambda: atlas.with_name(atlas.name + ".run.json").exists()))
        still, stubborn = self.wait_until_it_computes(job, 2)
        os.kill(still, signal.SIGSTOP)
        before = pauses(stubborn)
        os.kill(stubborn, signal.SIGTERM)
        self.assertTrue(wait_for(lambda: has_ended(stubborn) or pauses(stubborn) > before + 20))
        self.assertFalse(has_ended(stubborn), "the first signal is a request")

        def ends_after_another_signal():
            if not has_ended(stubborn):
                os.kill(stubborn, signal.SIGTERM)
            return has_ended(stubborn)

        # What follows the first within a fifth of a second belongs to it.
        self.assertTrue(wait_for(ends_after_another_signal))
        os.kill(still, signal.SIGKILL)
        self.assertNotIn(job.wait(timeout=60), (0, 10, 75))
        run, = self.runs(atlas)
        self.assertEqual((run["exit_code"], run["finished"], run["points_computed"]), (None, None, 0))

    def test_a_closed_pipe_on_stderr_does_not_stop_a_run(self):
        # Without mpirun: some versions of mpirun themselves do not survive it.
        atlas = self.directory / "unread.h5"
        job = self.start(None, long_scene(), atlas, "--progress", "bar")
        wait_for_points(job, atlas, 1)
        job.stderr.close()
        self.assertEqual(job.wait(timeout=60), 0)
        self.assertEqual(self.execute(None, "status", atlas).returncode, 0)


if __name__ == "__main__":
    unittest.main()

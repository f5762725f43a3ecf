"""Jobs are killed at random moments, again and again: ranks, mpirun, or all of them, creation and closing included.

After every kill the atlas is readable and has no wrong row; in the end it has the bytes of an uninterrupted run. What
is killed and when follows from a seed, RUBATLAS_SOAK_SEED in the environment; the machine's own timing does not.
"""
import itertools
import os
import pathlib
import random
import signal
import subprocess
import time
import unittest

import h5py

from job import FAILING, JobTest, has_ended, ranks_of, scene, wait_for, wait_for_points

SEED = int(os.environ.get("RUBATLAS_SOAK_SEED", "1"))
POINTS = 60


def scenes():
    """Points that continue, that are independent, and that leave the model, after which a line starts anew."""
    grid = {"speed_ratio": {"from": 0.2, "to": 0.9, "count": POINTS // 3}, "damping_ratio": [0.1, 0.15, 0.2]}
    protocol = {"transient_revolutions": 400, "sampled_revolutions": 10, "samples_per_revolution": 32,
                "settle": "never"}
    return [scene(grid=grid, protocol=protocol), scene(grid=grid, protocol=protocol, sweep="independent"),
            scene(grid={**grid, "damping_ratio": FAILING}, protocol=protocol, sweep="down")]


class Trial:
    """What is run and what is killed, all of it from one seed."""

    def __init__(self, number):
        chance = random.Random(SEED * 100000 + number)
        self.ranks = chance.choice((None, 1, 2, 2, 3))
        self.victim = "process" if self.ranks is None else chance.choice(("rank", "rank", "ranks", "mpirun", "all"))
        self.moment = chance.choice(("creation", "points", "points", "closing"))
        self.points = chance.randrange(POINTS * 3 // 4)
        # Under mpirun some tenths of a second pass before the atlas is created.
        self.delay = {"creation": chance.uniform(0.0, 0.1 if self.ranks is None else 0.5), "points": 0.0,
                      "closing": chance.uniform(0.0, 0.05)}[self.moment]
        self.batch_milliseconds = chance.choice((0, 5, 50))
        self.begins_anew = chance.random() < 0.5
        self.ranks_to_the_end = chance.choice((None, None, 2))
        self.chance = chance

    def __str__(self):
        return f"{self.victim} of {self.ranks} at {self.moment}, point {self.points}, {self.delay:.3f} s"

    def processes(self, job):
        ranks = [] if self.ranks is None else ranks_of(job)
        if self.victim == "rank":
            return ranks and [self.chance.choice(ranks)]
        return {"process": [job.pid], "ranks": ranks, "mpirun": [job.pid], "all": [job.pid, *ranks]}[self.victim]


class SoakTest(JobTest):
    def soak(self, kills):
        """At least `kills` kills, and on until more than a fifth of those hit a job at work, whatever the load."""
        contents = scenes()
        whole = [self.fill(None, content, f"whole{number}.h5") for number, content in enumerate(contents)]
        done, number, at_work, which, atlas = 0, 0, 0, 0, self.directory / "atlas.h5"
        while done < kills or at_work <= kills // 5:
            trial = Trial(number)
            number += 1
            if not atlas.exists():
                which = done % len(contents)
            with self.subTest(seed=SEED, number=number - 1, trial=str(trial)):
                if not self.killed(trial, contents[which], atlas):
                    continue
                done += 1
                if atlas.exists():
                    at_work += 0 < self.assert_no_wrong_row(atlas, whole[which]) < POINTS
                    verified = self.execute(None, "verify", atlas)
                    self.assertEqual(verified.returncode, 0, verified.stderr)
                if trial.begins_anew or done >= kills or self.is_complete(atlas):
                    self.assert_same_bytes(whole[which],
                                           self.fill(trial.ranks_to_the_end, contents[which], atlas.name, "--resume"))
                    atlas.unlink()
            self.assertLess(number, 3 * kills + 20, "most jobs end before they are killed, or are not yet at work")

    @staticmethod
    def is_complete(atlas):
        if not atlas.exists():
            return False
        with h5py.File(atlas, "r") as file:
            return bool((file["status"][...] != 0).all())

    def killed(self, trial, content, atlas):
        """Runs and kills; False where the job had ended before."""
        job = self.start(trial.ranks, content, atlas, "--resume", "--batch-milliseconds", str(trial.batch_milliseconds))
        if trial.moment != "creation":
            wait_for_points(job, atlas, trial.points if trial.moment == "points" else POINTS)
        time.sleep(trial.delay)
        victims = trial.processes(job)
        ranks = ranks_of(job)
        killed = False
        for victim in victims:
            try:
                os.kill(victim, signal.SIGKILL)
                killed = True
            except ProcessLookupError:
                pass
        if not killed:
            job.wait(timeout=60)
            return False
        self.wait_for_end(job, ranks, atlas)
        return job.returncode != 0

    def wait_for_end(self, job, ranks, atlas):
        """Ranks that have lost their mpirun notice it; until then they hold the lock of the atlas."""
        wait_for(lambda: all(map(has_ended, ranks)), 60)
        for rank in itertools.filterfalse(has_ended, ranks):
            # In MPI_Init a rank of Open MPI 4.1 sometimes waits for ever for an mpirun that is no more.
            self.assertFalse(self.has_opened(rank, atlas), "a rank outlives its job, with the atlas in its hands")
            os.kill(rank, signal.SIGKILL)
        try:
            job.wait(timeout=10)
        except subprocess.TimeoutExpired:
            # Where a rank dies in MPI_Init, the mpirun of Open MPI 4.1 sometimes waits for itself in
            # PMIx_server_finalize.
            self.assertTrue(ranks, "a process without mpirun has not ended")
            job.kill()
            job.wait()

    @staticmethod
    def has_opened(process, atlas):
        """The process has the atlas, its lock, or what is to become either, open."""
        opened = []
        for descriptor in pathlib.Path(f"/proc/{process}/fd").glob("*"):
            try:
                opened.append(os.readlink(descriptor))
            except FileNotFoundError:
                pass
        return any(str(atlas) in name for name in opened)


class Soak(SoakTest):
    def test_eight_random_kills_leave_no_wrong_row_and_the_same_bytes_in_the_end(self):
        self.soak(8)


class SoakOfTwoHundred(SoakTest):
    def test_two_hundred_random_kills_leave_no_wrong_row_and_the_same_bytes_in_the_end(self):
        self.soak(200)


if __name__ == "__main__":
    unittest.main()

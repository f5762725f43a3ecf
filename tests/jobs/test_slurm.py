"""Slurm itself runs the scripts: time limit, requeue, arrays; and srun with and without PMI."""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from slurm import Slurm

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))

from mpi_environment import CROWDED  # noqa: E402

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
PROGRAM = pathlib.Path(os.environ["RUBATLAS_PROGRAM"])
PATIENCE = 300  # s, on a machine that is busy with other tests


def scene(points, revolutions):
    """Four lines of the default rotor."""
    return {"title": "lines for Slurm", "reference": "none",
            "grid": {"speed_ratio": {"from": 0.2, "to": 0.9, "count": points}, "damping_ratio": [0.08, 0.1, 0.15, 0.2]},
            "protocol": {"transient_revolutions": revolutions, "sampled_revolutions": 8, "samples_per_revolution": 32},
            "spectrum": {"max_order": 4}}


def has_to_stop(process):
    """True where SIGUSR1 waits for a process that stands still."""
    pending, = re.findall(r"^ShdPnd:\s*(\w+)", pathlib.Path(f"/proc/{process}/status").read_text(), re.M)
    return bool(int(pending, 16) & 1 << signal.SIGUSR1 - 1)


class SlurmJobs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        directory = pathlib.Path(tempfile.mkdtemp(prefix="rubatlas_slurm_"))
        cls.addClassCleanup(shutil.rmtree, directory, ignore_errors=True)
        cls.slurm = Slurm(directory)
        cls.addClassCleanup(cls.slurm.close)

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="rubatlas_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.addCleanup(self.slurm.call, "scancel", "--user", self.slurm.user)  # what a test that fails leaves behind
        (self.folder / "jobs").symlink_to(ROOT / "jobs")
        self.environment = {**CROWDED, **self.slurm.environment, "RUBATLAS": str(PROGRAM)}

    def call(self, *command, **more):
        return self.slurm.call(*command, cwd=self.folder, env={**self.environment, **more})

    def whole(self, content):
        """Writes the scene's file; returns the bytes of its uninterrupted run."""
        (self.folder / "scene.json").write_text(json.dumps(content))
        job = subprocess.run([PROGRAM, "run", "scene.json", "-o", "whole.h5", "--progress", "off"], cwd=self.folder,
                             capture_output=True, text=True, check=False)
        self.assertEqual(job.returncode, 0, job.stderr)
        return (self.folder / "whole.h5").read_bytes()

    def submitted(self, *command, **more):
        job = self.call(*command, **more)
        self.assertEqual(job.returncode, 0, job.stderr)
        return job.stdout

    def wait_for_completion(self, job):
        """What the job, or all tasks of an array, have said in the end."""
        end = time.monotonic() + PATIENCE
        while (state := self.slurm.state(job)) != {"COMPLETED"} and "FAILED" not in state and time.monotonic() < end:
            time.sleep(0.2)
        said = "".join(path.read_text() for path in sorted(self.folder.glob(f"slurm-{job}*.out")))
        self.assertEqual(state, {"COMPLETED"}, said)
        return said

    def runs(self, atlas):
        return json.loads((self.folder / (atlas + ".run.json")).read_text())["runs"]

    def wait_until(self, condition, otherwise, pause=0.2):
        end = time.monotonic() + PATIENCE
        while not condition():
            self.assertLess(time.monotonic(), end, otherwise)
            time.sleep(pause)

    def ranks(self):
        """Processes of the program in this test's folder."""
        found = []
        for entry in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                folder, program = os.readlink(entry / "cwd"), os.readlink(entry / "exe")
                if folder == str(self.folder) and program == str(PROGRAM.resolve()):
                    found.append(int(entry.name))
            except OSError:
                pass  # gone in the meantime
        return found

    def test_an_array_of_jobs_computes_parts_and_a_last_job_merges_them_to_the_same_bytes(self):
        whole = self.whole(scene(10, 5))
        said = self.submitted("jobs/slurm_array.sh", "3", "1", "scene.json", "atlas.h5")
        array, merge = re.findall(r"job (\d+)", said)
        self.assertEqual(self.wait_for_completion(array).count("done: atlas.part"), 3)
        self.assertIn("atlas.h5: 40 of 40 points", self.wait_for_completion(merge))
        self.assertEqual(sorted(path.name for path in self.folder.glob("atlas.part*.h5")),
                         [f"atlas.part{number}of3.h5" for number in (1, 2, 3)])
        self.assertTrue((self.folder / "atlas.h5").read_bytes() == whole, "the atlas has other bytes")
        self.assertEqual([run["part"] for run in self.runs("atlas.h5")], ["1/3", "2/3", "3/3"])

    def srun(self, ranks, mpi):
        return self.call("srun", "-n", ranks, f"--mpi={mpi}", PROGRAM, "run", "scene.json", "-o", "atlas.h5",
                         "--progress",
                         "off")

    def test_srun_without_pmi_is_refused_by_each_of_its_tasks(self):
        self.whole(scene(10, 5))
        job = self.srun(3, "none")
        self.assertEqual(job.returncode, 3, job.stderr)
        for task in range(3):
            self.assertIn(f"rubatlas: this is task {task} of the 3 of a Slurm job, and none of them knows of "
                          "the others", job.stderr)
        self.assertFalse((self.folder / "atlas.h5").exists())

    def test_srun_with_pmix_starts_ranks_of_one_job(self):
        known = self.call("srun", "--mpi=list")
        if "pmix" not in known.stdout + known.stderr:
            self.skipTest("this Slurm has no PMIx")
        whole = self.whole(scene(10, 5))
        job = self.srun(2, "pmix")
        self.assertEqual(job.returncode, 0, job.stderr)
        self.assertEqual([run["ranks"] for run in self.runs("atlas.h5")], [2])
        self.assertTrue((self.folder / "atlas.h5").read_bytes() == whole, "the atlas has other bytes")

    def test_the_time_limit_of_a_job_requeues_it_and_it_goes_on_to_the_same_bytes(self):
        whole = self.whole(scene(40, 50))
        # The signal of a limit of a minute comes a minute before it: when Slurm looks for the first time.
        job = self.submitted("sbatch", "--parsable", "-n", "2", "--time=1", "--signal=B:USR1@60", "jobs/slurm.sh",
                             "scene.json",
                             "atlas.h5", RUBATLAS_REQUEUE="1").strip()
        # Slurm looks at time limits half a minute after its start, which is why this test is the last, and then twice a
        # minute. The ranks stand still until then, so that they are at work on any machine.
        self.wait_until((self.folder / "atlas.h5.run.json").exists, "the job does not begin", pause=0.005)
        ranks = self.ranks()
        self.assertEqual(len(ranks), 2)
        for rank in ranks:
            os.kill(rank, signal.SIGSTOP)
        self.wait_until(lambda: all(map(has_to_stop, ranks)), "no signal at the time limit")
        for rank in ranks:
            os.kill(rank, signal.SIGCONT)
        # For some seconds the job waits in the queue. It then has time enough, on a busy machine too.
        self.wait_until(lambda: self.slurm.state(job) == {"PENDING"}, "the job is not requeued")
        self.assertEqual(self.call("scontrol", "update", f"JobId={job}", "TimeLimit=60").returncode, 0)
        said = self.wait_for_completion(job)
        self.assertIn("stopped and resumable; to go on: sbatch -n 2 jobs/slurm.sh scene.json atlas.h5", said)
        self.assertTrue(said.endswith("done: atlas.h5\n"), said)
        runs = self.runs("atlas.h5")
        self.assertEqual([(run["exit_code"], run["resumed"], run["ranks"]) for run in runs],
                         [(75, True, 2), (0, True, 2)])
        self.assertEqual(sum(run["points_computed"] for run in runs), 160, "no point was computed twice")
        self.assertTrue((self.folder / "atlas.h5").read_bytes() == whole, "the atlas has other bytes")


if __name__ == "__main__":
    unittest.main()

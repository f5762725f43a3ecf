"""Slurm itself runs the scripts: time limit, requeue, arrays; and srun with and without PMI."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import time
import unittest

from slurm import PERIOD_OF_TIME_LIMITS, Slurm

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
PROGRAM = pathlib.Path(os.environ["RUBATLAS_PROGRAM"])
PATIENCE = 100  # s, on a machine that is busy with other tests


def scene(points, revolutions):
    """Four lines of the default rotor."""
    return {"title": "lines for Slurm", "reference": "none",
            "grid": {"speed_ratio": {"from": 0.2, "to": 0.9, "count": points}, "damping_ratio": [0.08, 0.1, 0.15, 0.2]},
            "protocol": {"transient_revolutions": revolutions, "sampled_revolutions": 8, "samples_per_revolution": 32},
            "spectrum": {"max_order": 4}}


class SlurmJobs(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="rubatlas_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        (self.folder / "slurm").mkdir()
        self.slurm = Slurm(self.folder / "slurm")
        self.addCleanup(self.slurm.close)
        (self.folder / "jobs").symlink_to(ROOT / "jobs")
        # As in jobs/mpi_environment.sh; more ranks than cores are welcome.
        self.environment = {**self.slurm.environment, "OMPI_ALLOW_RUN_AS_ROOT": "1", "RUBATLAS": str(PROGRAM),
                            "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
                            "OMPI_MCA_hwloc_base_binding_policy": "none", "OMPI_MCA_rmaps_base_oversubscribe": "1"}

    def call(self, *command, **more):
        return self.slurm.call(*command, cwd=self.folder, env={**self.environment, **more})

    def whole(self, content):
        """The scene's file, and the bytes of its uninterrupted run; also how long that took [s]."""
        (self.folder / "scene.json").write_text(json.dumps(content))
        began = time.monotonic()
        job = subprocess.run([PROGRAM, "run", "scene.json", "-o", "whole.h5", "--progress", "off"], cwd=self.folder,
                             capture_output=True, text=True, check=False)
        self.assertEqual(job.returncode, 0, job.stderr)
        return (self.folder / "whole.h5").read_bytes(), time.monotonic() - began

    def submitted(self, *command, **more):
        job = self.call(*command, **more)
        self.assertEqual(job.returncode, 0, job.stderr)
        return job.stdout

    def wait_for(self, job, *states):
        """What the job has said when it is in one of these states; it fails on the way to no other."""
        end = time.monotonic() + PATIENCE
        while not self.slurm.state(job) <= {*states} and time.monotonic() < end:
            time.sleep(0.2)
        said = "".join(path.read_text() for path in sorted(self.folder.glob(f"slurm-{job}*.out")))
        self.assertLessEqual(self.slurm.state(job), {*states}, said)
        return said

    def runs(self, atlas):
        return json.loads((self.folder / (atlas + ".run.json")).read_text())["runs"]

    def test_a_job_at_its_time_limit_is_requeued_and_goes_on_to_the_same_bytes(self):
        # Some seconds of work, however fast machine and program are.
        _, seconds = self.whole(scene(40, 50))
        (self.folder / "whole.h5").unlink()
        whole, seconds = self.whole(scene(40, int(50 * 6 / seconds)))
        # Slurm looks at time limits at fixed times. The job begins so shortly before one of them that it is at work then.
        at_work = 1.5 + min(seconds, PERIOD_OF_TIME_LIMITS) / 8
        running = time.monotonic() - self.slurm.started
        time.sleep(-(running + at_work) % PERIOD_OF_TIME_LIMITS)
        # The signal of a limit of a minute comes a minute before it, which is at the first look.
        job = self.submitted("sbatch", "--parsable", "-n", "2", "--time=1", "--signal=B:USR1@60", "jobs/slurm.sh", "scene.json",
                             "atlas.h5", RUBATLAS_REQUEUE="1").strip()
        said = self.wait_for(job, "COMPLETED")
        self.assertIn("stopped and resumable; to go on: sbatch -n 2 jobs/slurm.sh scene.json atlas.h5", said)
        self.assertIn("DUE TO JOB REQUEUE", said)
        self.assertTrue(said.endswith("done: atlas.h5\n"), said)
        runs = self.runs("atlas.h5")
        self.assertGreaterEqual(len(runs), 2)
        self.assertEqual([run["exit_code"] for run in runs], [75] * (len(runs) - 1) + [0])
        self.assertEqual({run["ranks"] for run in runs}, {2})
        self.assertEqual(sum(run["points_computed"] for run in runs), 160, "no point was computed twice")
        self.assertTrue((self.folder / "atlas.h5").read_bytes() == whole, "the atlas has other bytes")

    def test_an_array_of_jobs_computes_parts_and_a_last_job_merges_them_to_the_same_bytes(self):
        whole, _ = self.whole(scene(10, 5))
        said = self.submitted("jobs/slurm_array.sh", "3", "1", "scene.json", "atlas.h5")
        array, merge = re.findall(r"job (\d+)", said)
        self.assertEqual(self.wait_for(array, "COMPLETED").count("done: atlas.part"), 3)
        self.assertIn("atlas.h5: 40 of 40 points", self.wait_for(merge, "COMPLETED"))
        self.assertEqual(sorted(path.name for path in self.folder.glob("atlas.part*.h5")),
                         [f"atlas.part{number}of3.h5" for number in (1, 2, 3)])
        self.assertTrue((self.folder / "atlas.h5").read_bytes() == whole, "the atlas has other bytes")
        self.assertEqual([run["part"] for run in self.runs("atlas.h5")], ["1/3", "2/3", "3/3"])

    def srun(self, ranks, mpi):
        return self.call("srun", "-n", ranks, f"--mpi={mpi}", PROGRAM, "run", "scene.json", "-o", "atlas.h5", "--progress",
                         "off")

    def test_srun_without_pmi_is_refused_by_each_of_its_tasks(self):
        self.whole(scene(10, 5))
        job = self.srun(3, "none")
        self.assertEqual(job.returncode, 3, job.stderr)
        for task in range(3):
            self.assertIn(f"rubatlas: this is task {task} of the 3 of a Slurm job, and none of them knows of the others",
                          job.stderr)
        self.assertFalse((self.folder / "atlas.h5").exists())

    def test_srun_with_pmix_starts_ranks_of_one_job(self):
        known = self.call("srun", "--mpi=list")
        if "pmix" not in known.stdout + known.stderr:
            self.skipTest("this Slurm has no PMIx")
        whole, _ = self.whole(scene(10, 5))
        job = self.srun(2, "pmix")
        self.assertEqual(job.returncode, 0, job.stderr)
        self.assertEqual([run["ranks"] for run in self.runs("atlas.h5")], [2])
        self.assertTrue((self.folder / "atlas.h5").read_bytes() == whole, "the atlas has other bytes")


if __name__ == "__main__":
    unittest.main()

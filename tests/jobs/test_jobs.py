"""The scripts that run scenes, called as their users call them."""
import os
import pathlib
import signal
import subprocess
import tempfile
import time
import unittest

import h5py

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
PROGRAM = pathlib.Path(os.environ["RUBATLAS_PROGRAM"])
TINY = ROOT / "tests/tools/tiny.json"
PATIENCE = 120  # seconds, on a machine that is busy with other tests


def environment(**more):
    """As in a job of two ranks; root may call mpirun, and more ranks than cores are welcome."""
    return {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
            "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none",
            "OMPI_MCA_btl_vader_single_copy_mechanism": "none", "SLURM_NTASKS": "2", "RUBATLAS": str(PROGRAM), **more}


def run(*command, cwd=ROOT):
    return subprocess.run([*map(str, command)], cwd=cwd, env=environment(), stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, check=False)


class Jobs(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def test_install_has_nothing_to_do_where_all_is_there(self):
        ended = run(ROOT / "jobs/install.sh", "--tests")
        self.assertEqual((ended.returncode, ended.stdout, ended.stderr), (0, "", ""))

    def test_install_refuses_an_option_it_does_not_know(self):
        ended = run(ROOT / "jobs/install.sh", "--all")
        self.assertEqual(ended.returncode, 2)
        self.assertIn("--all is not an option; allowed: --tests", ended.stderr)

    def test_quickstart_explains_itself(self):
        ended = run(ROOT / "jobs/quickstart.sh", "--help")
        self.assertEqual(ended.returncode, 0)
        self.assertIn("./jobs/quickstart.sh jobs/rig.json", ended.stdout)
        self.assertEqual(run(ROOT / "jobs/quickstart.sh", "--fast").returncode, 2)

    def test_quickstart_ends_with_the_table_and_the_paths_of_atlas_and_pictures(self):
        for name in ("jobs", "tools", "tests"):
            (self.folder / name).symlink_to(ROOT / name)
        (self.folder / "build").symlink_to(PROGRAM.parent)
        first = run("jobs/quickstart.sh", TINY, cwd=self.folder)
        self.assertEqual(first.returncode, 0, first.stdout + first.stderr)
        self.assertIn("REGIONS AND TRIGGERS", first.stdout)
        self.assertIn("THE PAPER'S STATEMENTS", first.stdout)
        end = first.stdout[first.stdout.index("Atlas:"):]
        paths = [word for word in end.split() if word.startswith("atlases/")]
        self.assertGreaterEqual(len(paths), 3 + 6)
        for path in paths:
            self.assertGreater((self.folder / path).stat().st_size, 1000)

        again = run("jobs/quickstart.sh", TINY, cwd=self.folder)
        self.assertEqual(again.returncode, 0, again.stdout + again.stderr)
        self.assertIn("0 computed", again.stderr)

    def test_the_slurm_script_runs_a_scene_and_accepts_points_without_a_motion(self):
        ended = run("bash", ROOT / "jobs/slurm.sh", TINY, "atlas.h5", cwd=self.folder)
        self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)
        self.assertIn("done, some points without a motion (see /status): atlas.h5", ended.stdout)
        with h5py.File(self.folder / "atlas.h5") as atlas:
            self.assertTrue((atlas["status"][:] != 0).all())

    def test_the_slurm_script_stops_on_the_signal_and_says_how_to_go_on(self):
        with subprocess.Popen(["bash", ROOT / "jobs/slurm.sh", ROOT / "jobs/damping.json", "atlas.h5"], cwd=self.folder,
                              env=environment(SLURM_NTASKS="2"), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True) as job:
            until = time.monotonic() + PATIENCE
            while not (self.folder / "atlas.h5").exists() and time.monotonic() < until and job.poll() is None:
                time.sleep(0.05)
            time.sleep(1.0)  # let it compute
            job.send_signal(signal.SIGUSR1)
            said = job.communicate(timeout=PATIENCE)[0]
        self.assertEqual(job.returncode, 75, said)
        self.assertIn("stopped at the time limit and resumable; to go on: sbatch -n 2 jobs/slurm.sh", said)

    def test_the_slurm_script_refuses_a_call_without_a_scene(self):
        ended = run("bash", ROOT / "jobs/slurm.sh")
        self.assertEqual(ended.returncode, 2)
        self.assertIn("sbatch -n 64 jobs/slurm.sh jobs/damping.json", ended.stderr)

    def test_a_wrong_scene_keeps_its_exit_code(self):
        (self.folder / "wrong.json").write_text('{"grid": {"speed": 1}}')
        ended = run("bash", ROOT / "jobs/slurm.sh", "wrong.json", "atlas.h5", cwd=self.folder)
        self.assertEqual(ended.returncode, 2)
        self.assertIn("slurm.sh: the run ended with exit code 2", ended.stderr)


if __name__ == "__main__":
    unittest.main()

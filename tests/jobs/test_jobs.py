"""The scripts that run scenes, called as their users call them."""
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))

from mpi_environment import CROWDED  # noqa: E402

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
sys.path.insert(0, str(ROOT / "tests/mpi"))

from job import COMPUTING, processor_seconds, wait_for  # noqa: E402

PROGRAM = pathlib.Path(os.environ["RUBATLAS_PROGRAM"])
TINY = ROOT / "tests/tools/tiny.json"
PATIENCE = 120  # seconds, on a machine that is busy with other tests
ONE_CORE = {"OMP_NUM_THREADS": "1"}  # is what nproc answers then: scripts of many short runs start one rank for each


def environment(**more):
    """As in a job of two ranks."""
    return {**CROWDED, "SLURM_NTASKS": "2", "RUBATLAS": str(PROGRAM), **more}


def run(*command, cwd=ROOT, **more):
    return subprocess.run([*map(str, command)], cwd=cwd, env=environment(**more), stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, check=False)


def child_of(parent):
    """The process that another has started and waits for."""
    found, = pathlib.Path(f"/proc/{parent}/task/{parent}/children").read_text().split()
    return int(found)


def link(path):
    """Where a link leads; nowhere if its process is gone."""
    try:
        return os.readlink(path)
    except OSError:
        return None


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

    def install(self, there, offered):
        """What install.sh says as root where these packages are there and apt offers those; nothing is installed."""
        for name, text in (("id", "echo 0"), ("apt-get", "true"),
                           ("dpkg-query", f"printf '%s installed\\n' {' '.join(there)}"),
                           ("apt-cache", f"printf 'Package: %s\\n' {' '.join(offered)}")):
            (self.folder / name).write_text(f"#!/bin/sh\n{text}\n")
            (self.folder / name).chmod(0o755)
        ended = run(ROOT / "jobs/install.sh", PATH=f"{self.folder}:{os.environ['PATH']}")
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        return ended.stdout

    def test_install_takes_the_lowest_clang_for_web_assembly_of_which_all_is_offered_and_does_without_one(self):
        def wasm(number):
            return ["wasi-libc", f"clang-{number}", f"lld-{number}",
                    *(f"lib{name}-{number}-dev-wasm32" for name in ("c++", "c++abi", "clang-rt"))]

        without, installing = self.install(["bash"], ["bash"]).splitlines()
        self.assertIn("No clang for WebAssembly", without)
        needed = installing.removeprefix("Installing: ").split()
        self.assertIn("libhdf5-openmpi-dev", needed)
        self.assertEqual(self.install(needed, ["bash"]), without + "\n")
        offered = [*wasm(14), *(name for name in wasm(16) if name != "lld-16"), *wasm(19), *wasm(17), *wasm(100)]
        self.assertEqual(sorted(self.install(needed, offered).split()), sorted(["Installing:", *wasm(17)]))
        self.assertEqual(self.install([*needed, *wasm(19)], offered), "")

    def test_the_table_of_signs_counts_what_the_maps_say(self):
        ended = run(ROOT / "jobs/signature.py", TINY, "--limit", "4 mm", "--keep", self.folder)
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        header, _, row, _ = ended.stdout.splitlines()
        with h5py.File(self.folder / "tiny_maps.h5") as maps:
            table = {name: column[...] for name, column in maps["signature"].items()}
        self.assertTrue((table["limit_speed_ratio"] > 0.2).any())  # the first speed
        inside = table["limit_speed_ratio"] != 0.2
        table = {name: column[inside] for name, column in table.items()}
        passes = np.isfinite(table["limit_speed_ratio"])
        cells = dict(zip(header.split("|"), row.split("|")))
        self.assertEqual(cells[" scene "] + cells[" limit "], " `tiny`  4 mm ")
        self.assertEqual((int(cells[" lines "]), int(cells[" pass it "])), (inside.sum(), passes.sum()))
        for name, column in ((" n× line ", "passing_line"), (" displacement ", "displacement")):
            missed = passes.sum() - (table[f"{column}_speed_ratio"][passes] > 0.0).sum()
            self.assertEqual(f"{missed} missed" in cells[name], missed > 0)
            false = table[f"{column}_false"].sum()
            self.assertEqual(f"{false} false" in cells[name], false > 0)

    def test_quickstart_explains_itself(self):
        ended = run(ROOT / "jobs/quickstart.sh", "--help")
        self.assertEqual(ended.returncode, 0)
        self.assertIn("./jobs/quickstart.sh jobs/rig.json", ended.stdout)
        self.assertEqual(run(ROOT / "jobs/quickstart.sh", "--fast").returncode, 2)

    def test_quickstart_ends_with_the_table_and_the_paths_of_atlas_and_pictures(self):
        self.clone()
        ended = run("jobs/quickstart.sh", TINY, cwd=self.folder)
        self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)
        self.assertIn("REGIONS AND TRIGGERS", ended.stdout)
        end = ended.stdout[ended.stdout.rindex("Atlas:"):]
        paths = [word for word in end.split() if word.startswith("atlases/")]
        self.assertGreaterEqual(len(paths), 3 + 6)
        for path in paths:
            self.assertGreater((self.folder / path).stat().st_size, 1000)

    def all_ranks_compute(self):
        """All processes of the program that work in this test's folder."""
        ranks = [entry.name for entry in pathlib.Path("/proc").glob("[0-9]*")
                 if (link(entry / "exe"), link(entry / "cwd")) == (str(PROGRAM.resolve()), str(self.folder.resolve()))]
        return ranks and all(processor_seconds(rank) > COMPUTING for rank in ranks)

    def interrupt(self, command, atlas, send, **more):
        """Starts a script in a session of its own, waits until its ranks compute, lets `send` disturb the
        script's process, and returns its exit code and what it has said."""
        with subprocess.Popen([*map(str, command)], cwd=self.folder, env=environment(**more), stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              start_new_session=True) as job:
            wait_for(lambda: job.poll() is not None or ((self.folder / atlas).exists() and self.all_ranks_compute()))
            self.assertIsNone(job.poll(), "the script has ended")
            send(job)
            said = job.communicate(timeout=PATIENCE)[0]
        return job.returncode, said

    def interrupt_slurm(self, send):
        return self.interrupt(["bash", ROOT / "jobs/slurm.sh", ROOT / "jobs/damping.json", "atlas.h5"], "atlas.h5",
                              send)

    def points_computed(self, atlas):
        with h5py.File(self.folder / atlas) as file:
            return int((file["status"][:] != 0).sum()), file["status"].size

    def test_the_slurm_script_runs_a_scene_and_takes_points_outside_the_model_for_a_result(self):
        ended = run("bash", ROOT / "jobs/slurm.sh", TINY, "atlas.h5", cwd=self.folder)
        self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)
        self.assertIn("done: atlas.h5", ended.stdout)
        self.assertRegex(ended.stdout, r"points: \d+ done, [1-9]\d* outside the model, 0 failed\n")
        computed, all_points = self.points_computed("atlas.h5")
        self.assertEqual(computed, all_points)

    def test_the_slurm_script_stops_on_the_signal_and_says_how_to_go_on(self):
        code, said = self.interrupt_slurm(lambda job: job.send_signal(signal.SIGUSR1))
        self.assertEqual(code, 75, said)
        self.assertIn("stopped and resumable; to go on: sbatch -n 2 jobs/slurm.sh", said)

    def test_the_slurm_script_does_not_take_a_terminated_run_for_done(self):
        for which in (signal.SIGTERM, signal.SIGINT):
            with self.subTest(signal=which):
                code, said = self.interrupt_slurm(lambda job: os.kill(child_of(job.pid), which))
                self.assertNotIn(code, (0, 10), said)
                self.assertNotIn("done: ", said)
                self.assertIn("; to go on: sbatch -n 2 jobs/slurm.sh", said)
                computed, all_points = self.points_computed("atlas.h5")
                self.assertLess(computed, all_points)

    def under_a_launcher(self, text, scene=TINY):
        """What the Slurm script says where mpirun is this script of its own."""
        (self.folder / "mpirun").write_text(f"#!/bin/sh\nshift 2\n{text}\n")
        (self.folder / "mpirun").chmod(0o755)
        ended = run("bash", ROOT / "jobs/slurm.sh", scene, "atlas.h5", cwd=self.folder,
                    PATH=f"{self.folder}:{os.environ['PATH']}")
        return ended.returncode, ended.stdout + ended.stderr

    def test_the_slurm_script_asks_the_atlas_whether_it_is_complete_and_not_the_launcher(self):
        code, said = self.under_a_launcher("exit 1")
        self.assertEqual((code, "done: " in said), (1, False), said)
        code, said = self.under_a_launcher('"$@"; exit 1')
        self.assertEqual((code, "\ndone: atlas.h5\n" in said), (0, True), said)
        code, said = self.under_a_launcher('kill -USR1 $PPID; sleep 0.5; exit 1')
        self.assertEqual(code, 0, "the limit of time came behind the last point\n" + said)

        content = json.loads(TINY.read_text())
        content["rotor"] = {"damping_ratio": 0.11}
        (self.folder / "other.json").write_text(json.dumps(content))
        code, said = self.under_a_launcher("exit 1", self.folder / "other.json")
        self.assertEqual((code, "done: " in said), (1, False), "the atlas is that of another scene\n" + said)

        with h5py.File(self.folder / "atlas.h5", "r+") as file:
            file["status"][..., 0] = 0
        for launcher, expected in (("exit 1", 1), ("exit 0", 75)):
            code, said = self.under_a_launcher(launcher)
            self.assertEqual((code, "done: " in said), (expected, False), said)
            self.assertIn("; to go on: sbatch -n 2 jobs/slurm.sh", said)

    def clone(self):
        for name in ("jobs", "tools", "tests"):
            (self.folder / name).symlink_to(ROOT / name)
        (self.folder / "build").symlink_to(PROGRAM.parent)

    def clone_with_short_scenes(self, script, speeds):
        """A clone in which each scene that the script names has these speeds and few revolutions."""
        for name in ("jobs", "tools/pictures", "build"):
            (self.folder / name).mkdir(parents=True)
        (self.folder / "build/rubatlas").symlink_to(PROGRAM)
        (self.folder / "analysis").symlink_to(ROOT / "analysis")
        for name in ("rubatlas", "rubatlas-plot"):
            (self.folder / "tools" / name).symlink_to(ROOT / "tools" / name)
        for name in (script, "complete_atlas.sh", "mpi_environment.sh"):
            (self.folder / "jobs" / name).symlink_to(ROOT / "jobs" / name)
        words = set(re.findall(r"\w+", (ROOT / "jobs" / script).read_text()))
        for path in (ROOT / "jobs").glob("*.json"):
            if path.stem not in words:
                continue
            scene = json.loads(path.read_text())
            scene["grid"]["speed_ratio"] = speeds
            scene["protocol"] = {"transient_revolutions": 2, "sampled_revolutions": 4, "samples_per_revolution": 64}
            (self.folder / "jobs" / path.name).write_text(json.dumps(scene))

    def test_the_script_of_the_figures_draws_and_publishes_each_of_them(self):
        self.clone_with_short_scenes("figures.sh", [0.25, 0.3, 0.682, 0.686])  # in both zooms
        figures = {f"fig{number}.png" for number in ("2", "3", "4a", "4b", "4c", "9", "10a1", "10b1")}
        ended = run("jobs/figures.sh", "--publish", cwd=self.folder, **ONE_CORE)
        self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)
        for place in ("atlases/figures", "tools/pictures"):
            self.assertEqual({path.name for path in (self.folder / place).glob("*.png")}, figures)
        refused = run("jobs/figures.sh", "--all", cwd=self.folder)
        self.assertEqual((refused.returncode, "jobs/figures.sh --publish" in refused.stderr), (2, True))

    def test_the_script_of_the_statements_prints_a_verdict_on_each_and_publishes_two_maps(self):
        self.clone_with_short_scenes("statements.sh", {"from": 0.1, "to": 0.9, "count": 25})
        ended = run("jobs/statements.sh", "--publish", cwd=self.folder, **ONE_CORE)
        self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)
        for letter in ("P1a", "P2a", "P2b", "P8d", "P9a", "P10", "P11e", "P14a", "P15b", "P16", "P24"):
            self.assertRegex(ended.stdout, rf"(?m)^\W*{letter}\b")
        self.assertRegex(ended.stdout, r"(?m)P16\b.*agrees", "a closed form, whatever the speeds")
        self.assertEqual({path.name for path in (self.folder / "tools/pictures").glob("*.png")},
                         {"statement_map.png", "statement_map_phase.png"})

    def test_interrupting_quickstart_stops_it_and_says_how_to_go_on(self):
        self.clone()
        # As a terminal does at Ctrl-C: to all processes in the foreground.
        code, said = self.interrupt(["jobs/quickstart.sh", "jobs/damping.json"], "atlases/damping.h5",
                                    lambda job: os.killpg(job.pid, signal.SIGINT))
        self.assertEqual(code, 130, said)
        self.assertIn("Stopped; to go on from here: ./jobs/quickstart.sh", said)
        self.assertNotIn("4/5 Analyse", said)
        computed, all_points = self.points_computed("atlases/damping.h5")
        self.assertLess(computed, all_points)
        record, = json.loads((self.folder / "atlases/damping.h5.run.json").read_text())["runs"]
        self.assertEqual((record["exit_code"], record["points_finished"]), (75, computed))

    def test_the_slurm_script_refuses_a_call_without_a_scene(self):
        ended = run("bash", ROOT / "jobs/slurm.sh")
        self.assertEqual(ended.returncode, 2)
        self.assertIn("sbatch -n 64 jobs/slurm.sh jobs/damping.json", ended.stderr)

    def test_the_slurm_script_computes_the_part_of_its_task(self):
        ended = run("bash", ROOT / "jobs/slurm.sh", TINY, "atlas.h5", "2", cwd=self.folder)
        self.assertEqual(ended.returncode, 2)
        self.assertIn("sbatch --array=1-2", ended.stderr)
        ended = run("bash", ROOT / "jobs/slurm.sh", TINY, "atlas.h5", "2", cwd=self.folder, SLURM_ARRAY_TASK_ID="2")
        self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)
        self.assertIn("done: atlas.part2of2.h5", ended.stdout)
        with h5py.File(self.folder / "atlas.part2of2.h5") as file:
            self.assertEqual(file.attrs["part"], "2/2")

    def test_the_array_script_refuses_a_call_without_a_scene(self):
        ended = run("bash", ROOT / "jobs/slurm_array.sh", "8", "64")
        self.assertEqual(ended.returncode, 2)
        self.assertIn("jobs/slurm_array.sh PARTS RANKS SCENE.json", ended.stderr)

    def test_a_wrong_scene_keeps_its_exit_code(self):
        (self.folder / "wrong.json").write_text('{"grid": {"speed": 1}}')
        ended = run("bash", ROOT / "jobs/slurm.sh", "wrong.json", "atlas.h5", cwd=self.folder)
        self.assertEqual(ended.returncode, 2)
        self.assertIn("slurm.sh: the run ended with exit code 2", ended.stderr)


if __name__ == "__main__":
    unittest.main()

"""What is refused, with which sentence and exit code, before anything is written."""
import json
import os
import subprocess
import unittest

from job import JobTest, PROGRAM, scene, long_scene, wait_for_points


class Refusals(JobTest):
    def run_job(self, ranks, path, *options):
        return self.execute(ranks, "run", path, "-o", "atlas.h5", *options)

    def left_behind(self):
        return sorted(name for name in os.listdir(self.directory) if name != "scene.json")

    def test_a_wrong_scene_ends_with_2_and_one_sentence_for_any_number_of_ranks(self):
        path = self.write_scene(scene(contact={"friction": -0.1}))
        for ranks in (None, 1, 2, 3):
            with self.subTest(ranks=ranks):
                self.assert_refused(self.run_job(ranks, path), 2, "/contact/friction", "-0.1", "[0, 2]")
        self.assertEqual(self.left_behind(), [], "no file is made for a wrong scene")

    def test_a_missing_scene_ends_with_2_under_mpirun(self):
        self.assert_refused(self.run_job(2, self.directory / "missing.json"), 2, "missing.json")

    def test_an_existing_atlas_is_never_overwritten_unasked(self):
        atlas = self.fill(None, scene())
        before = atlas.read_bytes()
        for ranks in (None, 2):
            self.assert_refused(self.run_job(ranks, self.write_scene(scene())), 2, "atlas.h5", "--resume",
                                "--overwrite")
        self.assertEqual(atlas.read_bytes(), before)

    def test_overwrite_replaces_an_atlas_and_its_record(self):
        self.fill(None, scene(sweep="down"))
        atlas = self.fill(2, scene(), "atlas.h5", "--overwrite")
        self.assert_same_bytes(atlas, self.fill(None, scene(), "fresh.h5"))
        self.assertEqual(len(json.loads((self.directory / "atlas.h5.run.json").read_text())["runs"]), 1)

    def test_resume_and_overwrite_exclude_each_other(self):
        job = self.run_job(2, self.write_scene(scene()), "--resume", "--overwrite")
        self.assertEqual(job.returncode, 2, job.stderr)
        self.assertIn("--overwrite", job.stderr)
        self.assertEqual(self.left_behind(), [])

    def test_another_scenes_atlas_is_not_resumed_and_the_difference_is_named(self):
        atlas = self.fill(None, scene())
        before = atlas.read_bytes()
        other = self.write_scene(scene(contact={"friction": 0.2}))
        for ranks in (None, 2):
            self.assert_refused(self.run_job(ranks, other, "--resume"), 2, "another scene", "/contact/friction", "0.1",
                                "0.2")
        self.assertEqual(atlas.read_bytes(), before)

    def test_another_title_is_the_same_scene(self):
        atlas = self.fill(None, scene())
        before = atlas.read_bytes()
        self.fill(None, scene(title="another title"), "atlas.h5", "--resume")
        self.assertEqual(atlas.read_bytes(), before)

    def test_resume_without_an_atlas_makes_one(self):
        atlas = self.fill(2, scene(), "atlas.h5", "--resume")
        self.assert_same_bytes(atlas, self.fill(None, scene(), "fresh.h5"))

    def test_an_atlas_larger_than_the_disk_ends_with_3_before_the_first_point(self):
        # A row of 64 MB, a million of them.
        path = self.write_scene(scene(
            grid={"speed_ratio": {"from": 0.1, "to": 0.9, "count": 1000000}},
            protocol={"transient_revolutions": 0, "sampled_revolutions": 100000, "samples_per_revolution": 32},
            observables=["poincare", "poincare_blade_passing"]))
        for ranks in (None, 2):
            with self.subTest(ranks=ranks):
                self.assert_refused(self.run_job(ranks, path), 3, "atlas.h5", "TB", "has room for")
        self.assertEqual(self.left_behind(), [])

    def test_a_scene_larger_than_the_memory_says_what_is_too_large(self):
        for observable, memory in {"spectrum": "32 GB", "full_spectrum": "64 GB"}.items():
            path = self.write_scene(scene(
                grid={"speed_ratio": 0.5},
                protocol={"transient_revolutions": 0, "sampled_revolutions": 1000000, "samples_per_revolution": 2000},
                spectrum={"max_order": 1}, observables=[observable]))
            launcher = ["bash", "-c", f'ulimit -v 20000000; exec "{PROGRAM}" run "{path}" -o atlas.h5']
            job = subprocess.run(launcher, cwd=self.directory, text=True, capture_output=True, check=False)
            self.assert_refused(job, 3, "too large for the memory of ", f"{memory} for records and rows of the lines")
            self.assertEqual(self.left_behind(), [])

    def test_an_atlas_beyond_the_processs_own_limit_ends_with_3(self):
        path = self.write_scene(scene())
        launcher = ["bash", "-c", f'ulimit -f 8; exec "{PROGRAM}" run "{path}" -o atlas.h5']
        job = subprocess.run(launcher, cwd=self.directory, text=True, capture_output=True, check=False)
        self.assert_refused(job, 3, "ulimit -f")

    def test_a_directory_that_is_not_there_ends_with_3(self):
        job = self.execute(2, "run", self.write_scene(scene()), "-o", "nowhere/atlas.h5")
        self.assert_refused(job, 3, "nowhere", "No such file or directory")

    def test_a_file_that_is_no_atlas_is_not_resumed(self):
        (self.directory / "atlas.h5").write_text("a letter")
        self.assert_refused(self.run_job(2, self.write_scene(scene()), "--resume"), 3, "atlas.h5",
                            "cannot be opened: it is damaged")
        self.assertEqual((self.directory / "atlas.h5").read_text(), "a letter")

    def test_a_second_run_on_the_same_atlas_is_kept_out(self):
        atlas = self.directory / "atlas.h5"
        first = self.start(2, long_scene(), atlas)
        wait_for_points(first, atlas, 1)
        second = self.execute(None, "run", self.write_scene(long_scene()), "-o", atlas, "--resume")
        self.assert_refused(second, 3, "another run is filling")
        self.assertEqual(first.wait(timeout=60), 0)

    def test_tasks_of_srun_that_do_not_know_of_each_other_are_refused(self):
        path = self.write_scene(scene())
        slurm = {"SLURM_PROCID": "1", "SLURM_NTASKS": "4"}
        arguments = ("run", path, "-o", "atlas.h5")
        self.assert_refused(self.execute(None, *arguments, **slurm), 3, "task 1 of the 4", "mpirun -n 4",
                            "srun --mpi=pmix")
        # Singletons of an MPI that does not speak with this Slurm.
        self.assert_refused(self.execute(None, *arguments, **slurm, PMI_RANK="1"), 3, "task 1 of the 4")
        self.assertEqual(self.left_behind(), [])
        self.assertEqual(self.execute(2, *arguments, **slurm).returncode, 0, "mpirun knows its ranks")
        self.assertEqual(self.execute(None, "status", "atlas.h5", **slurm).returncode, 0, "nothing is filled")
        alone = self.execute(None, *arguments, "--resume", SLURM_PROCID="0", SLURM_NTASKS="4", SLURM_STEP_NUM_TASKS="1")
        self.assertEqual(alone.returncode, 0, alone.stderr)

    def test_a_dry_run_refuses_the_same_and_writes_nothing(self):
        path = self.write_scene(scene())
        job = self.run_job(2, path, "--dry-run")
        self.assertEqual((job.returncode, job.stderr), (0, ""))
        self.assertIn("36 points would be computed into atlas.h5; nothing has been written", job.stdout)
        self.assertEqual(job.stdout.count("Dry run"), 1, "one rank speaks")
        self.assertEqual(self.left_behind(), [])
        self.fill(None, scene())
        self.assert_refused(self.run_job(None, path, "--dry-run"), 2, "--overwrite")
        self.assertIn("Dry run: 0 points", self.run_job(None, path, "--dry-run", "--resume").stdout)


if __name__ == "__main__":
    unittest.main()

"""How a job ends and what it leaves on record: exit codes, failed points, the record, the cost of waiting."""
import json
import os
import resource
import unittest

import h5py
import numpy as np

from job import FAILING, INTEGRATOR_FAILED, LEFT_VALIDITY, JobTest, long_scene, scene


class Outcomes(JobTest):
    def failing_scene(self):
        content = scene()
        content["grid"]["damping_ratio"] = FAILING
        return content

    def test_a_job_whose_points_are_all_done_ends_with_0(self):
        for ranks in (None, 2):
            job = self.execute(ranks, "run", self.write_scene(scene()), "-o", f"atlas{ranks}.h5")
            self.assertEqual(job.returncode, 0, job.stderr)

    def test_points_outside_the_model_are_a_result_that_is_counted(self):
        for ranks in (None, 2):
            name = f"atlas{ranks}.h5"
            job = self.execute(ranks, "run", self.write_scene(self.failing_scene()), "-o", name)
            self.assertEqual(job.returncode, 0, job.stderr)
            with h5py.File(self.directory / name, "r") as atlas:
                status = atlas["status"][...].ravel()
            outside = int((status == LEFT_VALIDITY).sum())
            self.assertTrue(0 < outside < status.size and (status != 0).all())
            counts = f"36 of 36 points: {36 - outside} done, {outside} outside the model, 0 failed"
            self.assertIn(counts, job.stderr)
            self.assertNotIn("aborted", job.stderr, "mpirun has nothing to complain of")
            state = self.execute(None, "status", name)
            self.assertEqual((state.returncode, state.stdout, state.stderr), (0, f"{name}: {counts}\n", ""))

    def test_a_point_that_cannot_be_integrated_ends_the_job_with_10_and_says_which_and_why(self):
        # A damping that no double can add to the shaft's on one half of the lines; on the other a low damping ratio at
        # high speed leaves the model.
        content = scene(grid={"speed_ratio": [0.3, 0.5, 1.1], "damping_ratio": [0.02, 0.1],
                              "/support/damping_xx": [0, 1e15]},
                        protocol={"transient_revolutions": 2, "sampled_revolutions": 12, "samples_per_revolution": 32})
        files = []
        for ranks in (None, 2):
            name = f"atlas{ranks}.h5"
            job = self.execute(ranks, "run", self.write_scene(content), "-o", name)
            self.assertEqual(job.returncode, 10, job.stderr)
            with h5py.File(self.directory / name, "r") as atlas:
                status, detail, revolution = (atlas[of][...].reshape(2, 6)
                                              for of in ("status", "status_detail", "failed_revolution"))
                names = dict(zip(atlas["status_detail"].attrs["flag_values"],
                                 atlas["status_detail"].attrs["flag_meanings"].split()))
                displacement = atlas["max_displacement"][...].reshape(2, 6)
            self.assertEqual(status[1].tolist(), [INTEGRATOR_FAILED] * 6)
            self.assertEqual([names[number] for number in detail[1]], ["beyond_precision"] * 6)
            self.assertEqual(revolution[1].tolist(), [0] * 6, "of the first revolution")
            self.assertTrue(np.isnan(displacement[1]).all(), "a failed point has no numbers that look like results")
            outside = int((status[0] == LEFT_VALIDITY).sum())
            self.assertTrue(0 < outside < 6 and (status[0] != INTEGRATOR_FAILED).all(), status)
            counts = f"12 of 12 points: {6 - outside} done, {outside} outside the model, 6 failed"
            self.assertIn(counts, job.stderr)
            state = self.execute(None, "status", name)
            self.assertEqual((state.returncode, state.stdout, state.stderr), (10, f"{name}: {counts}\n", ""))
            self.assertEqual(json.loads((self.directory / f"{name}.run.json").read_text())["runs"][0]["exit_code"], 10)
            again = self.execute(ranks, "run", self.write_scene(content), "-o", name, "--resume")
            self.assertEqual(again.returncode, 10, "the atlas is as it was, and so is the code")
            self.assertIn("; 0 computed in", again.stderr)
            files.append(self.directory / name)
        self.assert_same_bytes(*files)

    def test_resuming_a_complete_atlas_with_points_outside_the_model_computes_nothing(self):
        path = self.write_scene(self.failing_scene())
        self.assertEqual(self.execute(None, "run", path, "-o", "atlas.h5").returncode, 0)
        before = (self.directory / "atlas.h5").read_bytes()
        job = self.execute(2, "run", path, "-o", "atlas.h5", "--resume")
        self.assertEqual(job.returncode, 0, job.stderr)
        self.assertIn("; 0 computed in", job.stderr)
        self.assertEqual((self.directory / "atlas.h5").read_bytes(), before)

    def test_what_differs_from_run_to_run_is_in_the_record(self):
        self.fill(2, scene())
        run, = json.loads((self.directory / "atlas.h5.run.json").read_text())["runs"]
        self.assertEqual((run["ranks"], run["points_total"], run["points_computed"]), (2, 36, 36))
        self.assertEqual(len(run["host_of_rank"]), 2)
        self.assertEqual(sum(run["points_of_rank"]), 36)
        self.assertGreater(run["right_hand_sides"], run["touchdowns"])
        self.assertGreater(run["wall_seconds"], 0.0)
        self.assertRegex(run["started"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$")

    def test_nothing_but_atlas_and_record_is_left(self):
        for ranks in (None, 3):
            self.fill(ranks, scene(), f"atlas{ranks}.h5")
        self.assertEqual(sorted(os.listdir(self.directory)),
                         ["atlas3.h5", "atlas3.h5.run.json", "atlasNone.h5", "atlasNone.h5.run.json", "scene.json"])

    def test_ranks_that_wait_do_not_burn_their_cores(self):
        # One line keeps one rank busy, whatever their number. A spinning rank would cost as much as the busy one.
        content = long_scene(sweep="up", transient_revolutions=1000)
        content["grid"]["damping_ratio"] = 0.1

        def processor_seconds(ranks):
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            self.fill(ranks, content, f"atlas{ranks}.h5")
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

        run = json.loads
        alone = processor_seconds(1)
        with_waiting = processor_seconds(3)
        busy = sum(run((self.directory / "atlas3.h5.run.json").read_text())["runs"][0]["busy_seconds_of_rank"])
        # Starting a rank costs some tenths of a second of processor time.
        self.assertLess(with_waiting - alone, 0.5 * busy + 0.3)


if __name__ == "__main__":
    unittest.main()

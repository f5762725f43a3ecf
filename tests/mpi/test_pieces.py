"""Lines swept in pieces: one atlas whatever the ranks and the kills, on the branch of the serial sweep."""
import json
import os
import random
import signal
import unittest

import h5py
import numpy as np

from job import DONE, JobTest, LEFT_VALIDITY, PENDING, ranks_of, scene, wait_for_points

NONE, AGREES, REPAIRED, APERIODIC = 0, 1, 2, 3
PIECES = {"points": 10, "lead_in": 2}


def line(**changes):
    """Lines of the default rotor through regions 2 and 3, in which branches end and motions are aperiodic."""
    return scene(**{"grid": {"speed_ratio": {"from": 0.3, "to": 0.7, "count": 60}, "damping_ratio": [0.1, 0.2]},
                    "protocol": {"transient_revolutions": 60, "sampled_revolutions": 40, "samples_per_revolution": 32},
                    "pieces": PIECES, **changes})


class Pieces(JobTest):
    def read(self, atlas, *names):
        with h5py.File(atlas, "r") as file:
            return [file[name][...].reshape(-1, *file[name].shape[file["status"].ndim:]) for name in names]

    def test_any_number_of_ranks_makes_the_same_bytes(self):
        for sweep, numbers in (("up", (2, 5)), ("down", (3,)), ("both", (2,))):
            alone = self.fill(None, line(sweep=sweep), "alone.h5", "--overwrite")
            (seam,) = self.read(alone, "seam")
            self.assertTrue({NONE, AGREES, REPAIRED, APERIODIC}.issuperset(seam))
            self.assertIn(AGREES, seam)
            for ranks in numbers:
                self.assert_same_bytes(alone, self.fill(ranks, line(sweep=sweep), f"ranks{ranks}.h5", "--overwrite"))

    def test_a_killed_rank_leaves_an_atlas_that_resumes_to_the_same_bytes(self):
        content = line(sweep="up", protocol={"transient_revolutions": 200, "sampled_revolutions": 40,
                                             "samples_per_revolution": 32})
        whole = self.whole(content)
        total, interrupted = 120, 0
        for seed, ranks in [(2, 3), (4, None)]:
            with self.subTest(seed=seed, ranks=ranks):
                chance = random.Random(seed)
                atlas = self.directory / f"killed{seed}.h5"
                for _ in range(2):  # what a kill has left may be killed again
                    job = self.start(ranks, content, atlas, "--resume")
                    wait_for_points(job, atlas, chance.randrange(0, total * 3 // 4))
                    victims = ranks_of(job) if ranks else [job.pid]
                    if victims:
                        os.kill(chance.choice(victims), signal.SIGKILL)
                    job.wait(timeout=60)
                    interrupted += self.check_rows_so_far(atlas, whole) < total
                self.assert_same_bytes(whole, self.fill(2, content, atlas.name, "--resume"))
        self.assertGreater(interrupted, 2, "most kills hit a job at work")

    def check_rows_so_far(self, atlas, whole):
        """A row that says done stands, whatever happens to the pieces around it; returns how many there are."""
        names = ("seam", "restarted", "poincare", "max_displacement", "final_state")
        status, *rows = self.read(atlas, "status", *names)
        for name, row, full in zip(names, rows, self.read(whole, *names)):
            np.testing.assert_array_equal(row[status != PENDING], full[status != PENDING], err_msg=name)
        return np.count_nonzero(status)

    def test_a_stopped_job_goes_on_to_the_same_bytes(self):
        content = line(protocol={"transient_revolutions": 200, "sampled_revolutions": 40, "samples_per_revolution": 32})
        whole = self.whole(content)
        atlas = self.directory / "stopped.h5"
        job = self.start(2, content, atlas)
        wait_for_points(job, atlas, 40)
        job.send_signal(signal.SIGUSR1)
        self.assertEqual(job.wait(timeout=60), 75)
        self.check_rows_so_far(atlas, whole)
        self.assert_same_bytes(whole, self.fill(3, content, atlas.name, "--resume"))

    def test_the_line_follows_the_branch_of_the_serial_sweep(self):
        # Through region 3 two motions coexist at some speeds. The tolerance of the comparison decides what a
        # periodic motion is; what is periodic in the serial sweep, and goes on from a periodic motion, has the same
        # displacement here. At a speed that is periodic among aperiodic ones the last digits of an aperiodic motion
        # decide whether the sweep finds the periodic one (jobs/studies/pieces.md).
        content = line(grid={"speed_ratio": {"from": 0.3, "to": 0.7, "count": 120}, "damping_ratio": 0.1},
                       protocol={"transient_revolutions": 200, "sampled_revolutions": 100,
                                 "samples_per_revolution": 32})
        pieces = self.fill(2, content, "pieces.h5")
        del content["pieces"]
        serial = self.fill(2, content, "serial.h5")
        with h5py.File(serial, "r") as file:
            self.assertNotIn("seam", file)
        moved, sections, still, where = [], *self.read(serial, "poincare", "max_displacement", "speed_ratio")
        (found,) = self.read(pieces, "max_displacement")
        periodic = [any(np.abs(record[p:] - record[:-p]).max() < 1e-9 for p in range(1, 17)) for record in sections]
        for i, repeats in enumerate(periodic):
            if repeats and (i == 0 or periodic[i - 1]) and abs(found[i] - still[i]) > 1e-6 * still[i]:
                moved.append((where[i % len(where)], still[i], found[i]))
        self.assertEqual(moved, [])
        self.assertGreater(sum(periodic), 60)

    def test_a_branch_that_only_the_sweep_reaches_is_repaired_to_its_end(self):
        content = line()
        atlas = self.fill(2, content)
        seam, restarted = self.read(atlas, "seam", "restarted")
        for of_line in np.flatnonzero(seam.reshape(2, -1)[:, 10] == REPAIRED):
            run = seam.reshape(2, -1)[of_line]
            self.assertTrue((run[10:np.flatnonzero(run[10:] != REPAIRED)[0] + 10] == REPAIRED).all())
        np.testing.assert_array_equal(np.flatnonzero(restarted), [0, 60],
                                      "only the ends of the lines start from `initial`")
        first_of_pieces = seam.reshape(2, -1)[:, 10::10]
        self.assertTrue((first_of_pieces != NONE).all(), "every seam was compared")

    def test_points_that_fail_at_a_seam_are_as_in_the_serial_sweep(self):
        content = line(grid={"speed_ratio": {"from": 0.5, "to": 1.3, "count": 40}, "damping_ratio": [0.05, 0.1]})
        atlas = self.fill(2, content, "pieces.h5")
        self.assert_same_bytes(atlas, self.fill(None, content, "alone.h5"))
        status, restarted, seam = self.read(atlas, "status", "restarted", "seam")
        self.assertIn(LEFT_VALIDITY, status[10::10], "points at seams have failed")
        behind = np.array([i for i in range(1, 80) if i % 40 != 0])
        # A point of a run that goes on from points that are not kept may be behind another end than stands there.
        behind = behind[(seam[behind] != AGREES) & (seam[behind] != APERIODIC)]
        np.testing.assert_array_equal(restarted[behind], status[behind - 1] != DONE)

    def test_seams_are_the_same_whatever_the_atlas_keeps(self):
        full = self.fill(None, line(), "full.h5")
        bare = self.fill(2, line(observables=["spectrum"]), "bare.h5")
        with h5py.File(bare, "r") as file:
            self.assertNotIn("poincare", file)
            self.assertNotIn("max_displacement", file)
        for one, other in zip(self.read(full, "seam", "spectrum", "final_state"),
                              self.read(bare, "seam", "spectrum", "final_state")):
            np.testing.assert_array_equal(one, other)

    def test_the_state_of_a_ring_crosses_seams(self):
        content = line(ring_body={"mass": 1.0, "compliance": 1e-4, "damping": 40.0})
        self.assert_same_bytes(self.fill(None, content, "alone.h5"), self.fill(3, content, "three.h5"))

    def test_rows_computed_again_have_the_same_bits(self):
        atlas = self.fill(2, line())
        job = self.execute(None, "verify", atlas, "--recompute", 40)
        self.assertEqual(job.returncode, 0, job.stderr)
        self.assertIn("40 of 40 computed again have the same bits", job.stdout)

    def test_long_lines_are_swept_in_pieces_unless_the_scene_says_null(self):
        def atlas_of(count, **changes):
            content = line(grid={"speed_ratio": {"from": 0.3, "to": 0.4, "count": count}},
                           protocol={"transient_revolutions": 2, "sampled_revolutions": 2}, **changes)
            if content["pieces"] is ...:
                del content["pieces"]
            return self.fill(2, content, "long.h5", "--overwrite")

        with h5py.File(atlas_of(257, pieces=...), "r") as file:
            self.assertEqual(json.loads(file["scene_resolved"][()])["pieces"], {"points": 48, "lead_in": 0})
            self.assertTrue((file["seam"][...].reshape(-1)[48::48] != NONE).all())
        with h5py.File(atlas_of(257, pieces=None), "r") as file:
            self.assertIsNone(json.loads(file["scene_resolved"][()])["pieces"])
            self.assertNotIn("seam", file)
        with h5py.File(atlas_of(256, pieces=...), "r") as file:
            self.assertNotIn("pieces", json.loads(file["scene_resolved"][()]))
            self.assertNotIn("seam", file)

    def test_pieces_where_no_line_can_be_cut_are_refused(self):
        self.assert_refused(self.execute(None, "run", self.write_scene(line(sweep="independent")), "-o", "a.h5"), 2,
                            "/pieces", "independent")
        worn = line(wear={"rate": 1e-9, "carries_over": True}, contact={"law": "elastica", "friction": 0.1})
        self.assert_refused(self.execute(None, "run", self.write_scene(worn), "-o", "a.h5"), 2, "/pieces",
                            "/wear/carries_over")


if __name__ == "__main__":
    unittest.main()

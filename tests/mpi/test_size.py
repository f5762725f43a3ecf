"""Large grids: what a rank keeps of them in memory is bounded by the bytes a point and a line that `explain` states."""
import os
import re
import signal
import subprocess
import unittest
import zlib

import h5py
import numpy as np

from job import ENVIRONMENT, JobTest, PROGRAM, ranks_of, wait_for_points

NOISE = 4_000_000  # B; by so much does the memory of a process differ from one time to the next


def idle_scene(side, speeds):
    """Points that cost nothing, on `side` squared lines: no blade reaches the ring, so that all rows are zero."""
    return {
        "title": "many points", "reference": "none", "rotor": {"misalignment": 0.001},
        "grid": {"speed_ratio": {"from": 0.1, "to": 0.8, "count": speeds} if speeds > 1 else 0.1,
                 "damping_ratio": {"from": 0.05, "to": 0.5, "count": side},
                 "friction": {"from": 0.05, "to": 0.5, "count": side}},
        "protocol": {"transient_revolutions": 0, "sampled_revolutions": 1, "samples_per_revolution": 32},
        "observables": ["spectrum"],
    }


def finish_every_other_point(atlas):
    """Each line then goes on from a stored state as often as it can."""
    with h5py.File(atlas, "r+") as file:
        row = b""
        for name in file["row_checksum"].attrs["order"].split():
            value = {"status": 1, "failed_revolution": -1}.get(name, 0)
            row += np.full(file[name].shape[5:], value, file[name].dtype).tobytes()
        status = np.zeros(file["status"].size, np.uint8)
        status[::2] = 1
        # As whole arrays: a number alone h5py writes row by row.
        for name, value in (("restarted", 0), ("final_state", 0), ("spectrum", 0), ("row_checksum", zlib.crc32(row))):
            file[name][...] = np.full(file[name].shape, value)
        file["status"][...] = status.reshape(file["status"].shape)
        return np.count_nonzero(status)


def largest_memory(process):
    """What a process has taken at most until now [B]."""
    with open(f"/proc/{process}/status") as file:
        return 1024 * int(re.search(r"VmHWM:\s+(\d+) kB", file.read()).group(1))


class Size(JobTest):
    def memory(self, ranks, content, atlas, finished=0, *options):
        """Largest memory of each rank after the first points of a job, which is then stopped."""
        job = self.start(ranks, content, atlas, *options)
        wait_for_points(job, atlas, finished + 1)
        self.assertIsNone(job.poll(), "there are points left")
        of_rank = [largest_memory(process) for process in (ranks_of(job) if ranks else [job.pid])]
        job.send_signal(signal.SIGUSR1)
        self.assertEqual(job.wait(timeout=60), 75)
        return np.array(of_rank)

    def check(self, side, speeds):
        content, atlas = idle_scene(side, speeds), self.directory / "atlas.h5"
        said = subprocess.run([PROGRAM, "explain", self.write_scene(content)], capture_output=True, text=True,
                              check=True)
        of_point, of_line = map(int, re.search(r"\((\d+) bytes a point, (\d+) a line\)", said.stdout).groups())
        bound = (of_point * speeds + of_line) * side**2
        few = self.memory(None, idle_scene(40, 1), self.directory / "few.h5")
        self.assertLess(self.memory(None, content, atlas) - few, bound + NOISE)
        finished = finish_every_other_point(atlas)
        self.assertLess(self.memory(None, content, atlas, finished, "--resume") - few, bound + NOISE)

    def test_long_lines_take_no_more_memory_than_is_stated(self):
        self.check(20, 1000)

    def test_lines_of_one_point_take_no_more_memory_than_is_stated(self):
        self.check(400, 1)

    def test_ranks_other_than_the_first_keep_nothing_of_points_that_they_do_not_compute(self):
        _, few = self.memory(2, idle_scene(40, 1), self.directory / "few.h5")
        _, many = self.memory(2, idle_scene(400, 1), self.directory / "many.h5")
        self.assertLess(many - few, NOISE)

    def test_a_grid_that_memory_cannot_hold_is_refused_before_an_atlas_is_created(self):
        path = self.write_scene(idle_scene(4000, 1))
        job = subprocess.run(["bash", "-c", f'ulimit -v 2000000; exec "{PROGRAM}" run "{path}" -o atlas.h5'],
                             cwd=self.directory,
                             env=ENVIRONMENT, text=True, capture_output=True, check=False)
        self.assert_refused(job, 3, "too large for the memory of ", "in the first rank ", "bytes a point")
        self.assertEqual(os.listdir(self.directory), ["scene.json"])


if __name__ == "__main__":
    unittest.main()

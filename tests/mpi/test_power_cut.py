"""Whatever a power cut leaves on the disk, a status that is there has its row."""
import glob
import os
import random
import struct
import unittest

import h5py
import numpy as np

from job import ENVIRONMENT, JobTest, PENDING, command, long_scene, scene

import subprocess

BLOCK = 512  # B; what a disk writes as a whole


class Log:
    """What one process has written into the atlas: entries (offset, bytes), or None where it was flushed to disk."""

    def __init__(self, path):
        with open(path, "rb") as file:
            raw = file.read()
        self.entries, at = [], 0
        while at < len(raw):
            offset, length = struct.unpack_from("<qq", raw, at)
            at += 16
            self.entries.append(None if offset < 0 else (offset, raw[at:at + length]))
            at += length

    def after_a_cut(self, chance, at):
        """Writes that are on the disk when power fails after entry `at`: all that were brought there, and of the
        others any blocks, since pages come to the disk when and in the order in which the system likes."""
        begun = self.entries[:at]
        brought = max((i for i, entry in enumerate(begun) if entry is None), default=0)
        for i, entry in enumerate(begun):
            if entry is None:
                continue
            if i < brought:
                yield entry
                continue
            offset, data = entry
            while data:
                length = BLOCK - offset % BLOCK
                if chance.random() < 0.5:
                    yield offset, data[:length]
                offset, data = offset + length, data[length:]


class PowerCut(JobTest):
    def record(self, ranks, content):
        """Runs a scene to its end; its atlas, and one log per process."""
        atlas = self.directory / "atlas.h5"
        environment = {**ENVIRONMENT, "LD_PRELOAD": os.environ["RUBATLAS_RECORDED_WRITES"], "RECORDED_FILE": atlas.name,
                       "RECORDED_LOG": str(self.directory / "log")}
        job = subprocess.run(command(ranks, "run", self.write_scene(content), "-o", atlas, "--progress", "off",
                                     "--batch-milliseconds", "0"),
                             env=environment, cwd=self.directory, capture_output=True, text=True, check=False,
                             timeout=120)
        self.assertEqual(job.returncode, 0, job.stderr)
        logs = [Log(path) for path in sorted(glob.glob(str(self.directory / "log.*")))]
        self.assertEqual(len(logs), ranks or 1, "every process writes its own rows")
        return atlas, logs

    def fresh_bytes(self, atlas):
        """The atlas as it was before its first row, and the places of its rows: name, offset, bytes."""
        image = bytearray(atlas.read_bytes())
        places = []
        with h5py.File(atlas, "r") as file:
            for name in [*file["row_checksum"].attrs["order"].split(), "row_checksum"]:
                begin, size = file[name].id.get_offset(), file[name].size * file[name].dtype.itemsize
                image[begin:begin + size] = (b"\xff" if name == "failed_revolution" else b"\0") * size
                places.append((name, begin, size))
        return image, places

    def check_cuts(self, ranks, content, cuts):
        atlas, logs = self.record(ranks, content)
        final = np.frombuffer(atlas.read_bytes(), np.uint8)
        fresh, places = self.fresh_bytes(atlas)
        (_, status_begin, points), chance, partial = places[0], random.Random(1), 0
        for cut in range(cuts):
            image = bytearray(fresh)
            for log in logs:
                for offset, data in log.after_a_cut(chance, chance.randrange(len(log.entries) + 1)):
                    image[offset:offset + len(data)] = data
            left = np.frombuffer(image, np.uint8)
            finished = left[status_begin:status_begin + points] != PENDING
            partial += 0 < finished.sum() < points
            for name, begin, size in places:
                rows = [bytes_[begin:begin + size].reshape(points, -1)[finished] for bytes_ in (left, final)]
                self.assertTrue(np.array_equal(*rows), f"cut {cut}: a status without its row in /{name}")
        self.assertGreater(partial, cuts // 2, "most cuts hit a job at work")
        # The last image goes on like any other atlas.
        (self.directory / "cut.h5").write_bytes(bytes(image))
        job = self.execute(None, "verify", "cut.h5")
        self.assertEqual(job.returncode, 0, job.stderr)
        self.fill(None, content, "cut.h5", "--resume")
        self.assert_same_bytes(atlas, self.directory / "cut.h5")
        return atlas, logs, fresh

    def test_no_status_comes_to_the_disk_before_its_row(self):
        self.check_cuts(None, scene(), 100)

    def test_no_status_comes_to_the_disk_before_its_row_on_several_ranks(self):
        self.check_cuts(3, scene(sweep="both"), 60)

    def test_what_a_run_that_ended_has_written_is_on_the_disk(self):
        atlas, logs = self.record(2, scene())
        image, _ = self.fresh_bytes(atlas)
        for log in logs:
            brought = max(i for i, entry in enumerate(log.entries) if entry is None)
            for offset, data in filter(None, log.entries[:brought]):
                image[offset:offset + len(data)] = data
        self.assertEqual(bytes(image), atlas.read_bytes())

    def test_statuses_wait_for_seconds_and_not_for_the_end(self):
        atlas = self.directory / "atlas.h5"
        job = subprocess.Popen(command(None, "run", self.write_scene(long_scene()), "-o", atlas, "--progress", "off",
                                       "--batch-milliseconds", "100"), env=ENVIRONMENT, cwd=self.directory)
        self.addCleanup(lambda: (job.poll() is None and job.kill(), job.wait()))
        seen = 0
        while job.poll() is None and not 0 < seen < 180:
            if atlas.exists():
                with h5py.File(atlas, "r") as file:
                    seen = np.count_nonzero(file["status"][...])
        self.assertTrue(0 < seen < 180, f"{seen} points were seen while the job was at work")


if __name__ == "__main__":
    unittest.main()

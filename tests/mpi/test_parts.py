"""A scene computed in parts and merged, or packed, is the atlas of a single run."""
import json
import os
import shutil
import signal
import struct
import subprocess
import time
import unittest
import zlib

import h5py
import numpy as np

from atlas_contract import departures
from job import FAILING, JobTest, PENDING, PROGRAM, scene, wait_for_points
from test_wear import wearing


def five_lines(**changes):
    """Five lines of the default rotor, on two of which some points leave the model's validity."""
    return scene(grid={"speed_ratio": {"from": 0.2, "to": 0.9, "count": 6}, "damping_ratio": [*FAILING, 0.15, 0.2]},
                 **changes)


def two_long_lines():
    """Long enough that something can happen in the middle."""
    return scene(grid={"speed_ratio": {"from": 0.2, "to": 0.8, "count": 40}, "damping_ratio": [0.1, 0.2]},
                 protocol={"transient_revolutions": 150, "sampled_revolutions": 20, "samples_per_revolution": 32})


class PartTest(JobTest):
    def part(self, content, number, count, ranks=None, code=0):
        """Computes a part; returns its name."""
        name = f"part{number}of{count}.h5"
        job = self.execute(ranks, "run", self.write_scene(content), "-o", name, "--part", f"{number}/{count}",
                           "--progress", "off")
        self.assertEqual(job.returncode, code, job.stderr)
        return name

    def parts(self, content, count):
        return [self.part(content, number, count) for number in range(1, count + 1)]

    def merge(self, names, output="merged.h5", *options, ranks=None):
        return self.execute(ranks, "merge", *names, "-o", output, *options)

    def assert_merged(self, whole, names, ranks=None):
        job = self.merge(names, "merged.h5", "--overwrite", ranks=ranks)
        self.assertEqual((job.returncode, job.stderr), (0, ""))
        self.assert_same_bytes(whole, self.directory / "merged.h5")

    def names(self):
        return sorted(os.listdir(self.directory))


class Parts(PartTest):
    def test_merged_parts_have_the_bytes_of_a_single_run(self):
        for sweep, count in (("up", 5), ("both", 3), ("independent", 2)):
            with self.subTest(sweep=sweep, parts=count):
                content = five_lines(sweep=sweep)
                names = [self.part(content, number, count, ranks=2 if number == 1 else None)
                         for number in range(1, count + 1)]
                self.assert_merged(self.fill(None, content, f"{sweep}.h5"), names[::-1])

    def test_one_rank_of_several_merges(self):
        content = five_lines()
        self.assert_merged(self.fill(None, content, "whole.h5"), self.parts(content, 2), ranks=2)

    def test_parts_whose_lines_are_swept_in_pieces_have_the_bytes_of_a_single_run(self):
        # Seams on each line, behind points that have left the model's validity too.
        content = five_lines(pieces={"points": 2, "lead_in": 1})
        whole = self.fill(3, content, "whole.h5")
        names = [self.part(content, number, 2, ranks) for number, ranks in ((1, 2), (2, None))]
        for name, lines in zip(names, (slice(0, 2), slice(2, 5))):
            self.assertEqual(departures(self.directory / name), [])
            with h5py.File(self.directory / name) as file:
                compared = (file["seam"][...].reshape(5, 6) != 0).any(axis=1)
            self.assertEqual([line for line in range(5) if compared[line]], list(range(5))[lines], name)
        self.assert_merged(whole, names)
        job = self.execute(None, "verify", "merged.h5", "--recompute", 30)
        self.assertEqual((job.returncode, job.stderr), (0, ""))

    def test_what_effects_remember_is_merged(self):
        content = wearing(scene)
        self.assert_merged(self.fill(None, content, "whole.h5"), self.parts(content, 3))

    def test_a_part_is_an_atlas_that_says_which_lines_it_has(self):
        name = self.part(five_lines(), 2, 3)
        self.assertEqual(departures(self.directory / name), [])
        with h5py.File(self.directory / name) as file:
            self.assertEqual(file.attrs["part"], "2/3")
            computed = (file["status"][...] != PENDING).reshape(5, 6)
        # Of L lines, part k of n has those from (k - 1) L // n to k L // n.
        np.testing.assert_array_equal(computed.all(axis=1), [False, True, True, False, False])
        np.testing.assert_array_equal(computed.any(axis=1), computed.all(axis=1))
        state = self.execute(None, "status", name)
        self.assertEqual(state.returncode, 0)
        self.assertIn(f"{name} (part 2/3): 12 of 12 points", state.stdout)
        self.assertNotIn("part", h5py.File(self.fill(None, five_lines(), "whole.h5")).attrs)

    def test_a_stopped_part_is_resumed_as_the_part_that_it_is(self):
        content = two_long_lines()
        whole = self.fill(None, content, "whole.h5")
        first = self.directory / "part1of2.h5"
        job = self.start(None, content, first, "--part", "1/2")
        wait_for_points(job, first, 10)
        job.send_signal(signal.SIGUSR1)
        self.assertEqual(job.wait(timeout=60), 75)
        self.assertIn("--part 1/2 ", job.stderr.read(), "the command to go on")
        second = self.part(content, 2, 2)

        merged = self.merge([first, second])
        self.assertEqual(merged.returncode, 75, merged.stderr)
        self.assertRegex(merged.stderr, r"^rubatlas: incomplete: .*part1of2\.h5 \(part 1/2\): \d+ of 40 points")
        self.assert_same_bytes(whole, self.fill(2, content, "merged.h5", "--resume"))

        self.fill(2, content, first.name, "--resume")
        with h5py.File(first) as file:
            self.assertEqual(np.count_nonzero(file["status"][...]), 40, "no line of another part")
        self.assert_merged(whole, [first, second])
        runs = json.loads((self.directory / "merged.h5.run.json").read_text())["runs"]
        self.assertEqual([(run["part"], run["exit_code"]) for run in runs], [("1/2", 75), ("1/2", 0), ("2/2", 0)])

    def test_missing_parts_are_named_and_stay_pending_for_a_run(self):
        content = five_lines()
        names = self.parts(content, 5)
        job = self.merge([names[3], names[0]])
        self.assertEqual(job.returncode, 75)
        self.assertEqual(job.stderr, "rubatlas: missing: parts 2/5, 3/5, 5/5\n")
        self.assertRegex(job.stdout,
                         r"^merged\.h5: 12 of 30 points: .*; 18 pending: `rubatlas run SCENE -o merged\.h5 --resume`")
        self.assertEqual(departures(self.directory / "merged.h5"), [])
        self.assert_same_bytes(self.fill(None, content, "whole.h5"), self.fill(2, content, "merged.h5", "--resume"))

    def test_points_that_could_not_be_integrated_leave_their_exit_code(self):
        # A damping that no double can add to the shaft's.
        content = scene(grid={"speed_ratio": [0.3, 0.5], "/support/damping_xx": [0, 1e15]})
        names = [self.part(content, number, 2, code=code) for number, code in ((1, 0), (2, 10))]
        job = self.merge(names)
        self.assertEqual(job.returncode, 10, job.stderr)
        self.assertIn("4 of 4 points: 2 done, 0 outside the model, 2 failed", job.stdout)

    def parts_with_rows_of(self, sampled):
        """Motions that never touch cost little, however long their rows: 13 000 revolutions are 0.4 MB."""
        return self.parts(scene(grid={"speed_ratio": {"from": 0.1, "to": 0.2, "count": 60},
                                      "damping_ratio": [0.1, 0.2]},
                                rotor={"misalignment": 0.0}, observables=["poincare"],
                                protocol={"transient_revolutions": 0, "sampled_revolutions": sampled,
                                          "samples_per_revolution": 32}), 2)

    def test_a_merge_that_is_stopped_leaves_nothing(self):
        names = self.parts_with_rows_of(13000)
        before = self.names()
        with subprocess.Popen([PROGRAM, "merge", *names, "-o", "merged.h5"], cwd=self.directory, stderr=subprocess.PIPE,
                              text=True) as job:
            while len(self.names()) == len(before) and job.poll() is None:
                time.sleep(0.0005)
            job.send_signal(signal.SIGTERM)
            said = job.communicate(timeout=60)[1]
        self.assertEqual((job.returncode, said), (75, "rubatlas: stopped; merged.h5 has not been written\n"))
        self.assertEqual(self.names(), before)

    def test_a_merge_takes_little_memory(self):
        def most_memory(sampled):
            names = self.parts_with_rows_of(sampled)
            script = ("import resource, subprocess, sys;"
                      " subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL);"
                      "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)")
            job = subprocess.run(["/usr/bin/python3", "-c", script, PROGRAM, "merge", *names, "-o", "merged.h5"],
                                 cwd=self.directory, capture_output=True, text=True, check=False)
            self.assertEqual(job.returncode, 0, job.stderr)
            size = (self.directory / "merged.h5").stat().st_size
            for name in (*names, "merged.h5"):
                (self.directory / name).unlink()
            return int(job.stdout) * 1024, size

        little, small = most_memory(10)
        much, large = most_memory(13000)
        self.assertGreater(large - small, 45e6)
        self.assertLess(much - little, 25e6)


class PartRefusals(PartTest):
    def test_a_part_that_is_none_is_refused(self):
        path = self.write_scene(five_lines())
        for text in ("2", "0/3", "4/3", "a/b", "2/3/4", "-1/3", "1/"):
            with self.subTest(part=text):
                job = self.execute(None, "run", path, "-o", "a.h5", f"--part={text}")
                self.assert_refused(job, 2, f"--part {text}: not K/N with K from 1 to N, such as 2/8")
        self.assert_refused(self.execute(2, "run", path, "-o", "a.h5", "--part", "1/6"), 2,
                            "--part 1/6: the scene has 5 lines, and a part has one at least")
        self.assertEqual(self.names(), ["scene.json"])

    def test_an_atlas_is_resumed_as_no_other_part(self):
        name = self.part(five_lines(), 2, 3)
        whole = self.fill(None, five_lines(), "whole.h5")
        before = (self.directory / name).read_bytes(), whole.read_bytes()
        for atlas, what in ((name, "part 2/3"), ("whole.h5", "a whole atlas")):
            job = self.execute(None, "run", "scene.json", "-o", atlas, "--part", "1/3", "--resume")
            self.assert_refused(job, 2, f"{atlas} is {what}, and --part asks for part 1/3")
        self.assertEqual(((self.directory / name).read_bytes(), whole.read_bytes()), before)

    def test_a_dry_run_of_a_part_counts_its_points(self):
        job = self.execute(None, "run", self.write_scene(five_lines()), "-o", "a.h5", "--part", "2/3", "--dry-run")
        self.assertIn("Dry run: 12 points would be computed into a.h5 (part 2/3 of the scene: lines 2 to 3 of 5)",
                      job.stdout)

    def test_what_does_not_belong_together_is_not_merged(self):
        first, second = self.parts(five_lines(), 2)
        other = self.part(five_lines(sweep="down"), 2, 3)
        third = self.part(five_lines(), 3, 3)
        (self.directory / "letter.h5").write_text("a letter")
        before = self.names()
        self.assert_refused(self.merge([first, second, first]), 2,
                            "part1of2.h5 and part1of2.h5 have the same lines: each is part 1/2")
        self.assert_refused(self.merge([first, third]), 2, "part1of2.h5 is part 1/2 and part3of3.h5 is part 3/3",
                            "not parts of one division")
        self.assert_refused(self.merge([first, other]), 2, "part2of3.h5 was made from another scene than part1of2.h5",
                            '/sweep is "down" in the first and "up" in the second')
        self.assert_refused(self.merge([first, "letter.h5"]), 3, "letter.h5", "cannot be opened")
        self.assert_refused(self.merge([first, "nowhere.h5"]), 3, "nowhere.h5", "No such file")
        self.assert_refused(self.merge([first, second], first), 2, "the same file")
        self.assert_refused(self.merge([first, second], first, "--overwrite"), 2, "the same file")
        self.assert_refused(self.merge([first, second], other), 2, "part2of3.h5 exists; --overwrite replaces it")
        self.assert_refused(self.merge([first, second], "letter.h5", "--overwrite"), 2,
                            "letter.h5 is no file of rubatlas")
        self.assert_refused(self.merge([first, second], "nowhere/merged.h5"), 3, "No such file or directory")
        self.assertEqual(self.names(), before)

    def test_parts_of_other_builds_are_merged_with_a_remark(self):
        first, second = self.parts(five_lines(), 2)
        with h5py.File(self.directory / first) as file:
            commit = file.attrs["git_commit"].encode()
        self.change_header(second, commit, b"0" * len(commit))
        job = self.merge([second, first])
        self.assertEqual(job.returncode, 0)
        self.assertRegex(job.stderr,
                         f"^rubatlas: part1of2.h5 was begun by commit {commit.decode()} .*, part2of2.h5 by 0+ .*: "
                         "points may differ in the last digits")
        self.assertEqual(h5py.File(self.directory / "merged.h5").attrs["git_commit"].encode(), commit)

    def change_header(self, name, old, new):
        """As another build would have written it: with a checksum of its own."""
        content = bytearray((self.directory / name).read_bytes().replace(old, new))
        place = content.index(b"rubatlas header\n") + 16
        count, = struct.unpack_from("<I", content, place + 4)
        left_out = sorted([(20, 24), (place, place + 4),
                           *struct.iter_unpack("<QQ", content[place + 8:place + 8 + 16 * count])])
        checksum, at = 0, 0
        for begin, end in [*left_out, (len(content), len(content))]:
            checksum = zlib.crc32(content[at:begin], checksum)
            at = max(at, end)
        struct.pack_into("<I", content, place, checksum)
        (self.directory / name).write_bytes(content)

    def test_damage_in_a_part_stops_the_merge(self):
        first, second = self.parts(five_lines(), 2)
        shutil.copy(self.directory / second, self.directory / "sound.h5")
        with h5py.File(self.directory / second, "r+") as file:
            file["max_displacement"][0, 0, 0, 3, 2] += 1e-9
        before = self.names()
        self.assert_refused(self.merge([first, second]), 3, "part2of2.h5 is damaged: the row at speed_ratio=0.48",
                            "damping_ratio=0.15")
        with h5py.File(self.directory / "sound.h5", "r+") as file:
            file["max_displacement"].attrs["long_name"] = "something else"
        self.assert_refused(self.merge([first, "sound.h5"]), 3, "sound.h5 is damaged", "something besides its rows")
        self.assertEqual(self.names(), before)


class Packed(PartTest):
    def pack(self, *arguments):
        return self.execute(None, "pack", *arguments)

    def test_a_packed_atlas_has_the_same_rows_and_every_reader_reads_it(self):
        loose = self.fill(None, five_lines(), "loose.h5")
        job = self.pack("loose.h5", "-o", "tight.h5")
        self.assertEqual((job.returncode, job.stderr), (0, ""))
        self.assertRegex(job.stdout,
                         r"^tight\.h5: [\d.]+ kB \(\d+ % of the [\d.]+ kB of loose\.h5\); all rows of its 30 finished")
        tight = self.directory / "tight.h5"
        self.assertEqual(departures(tight), [])
        with h5py.File(loose) as before, h5py.File(tight) as file:
            self.assertEqual(set(before), set(file))
            for name in before:
                self.assertEqual(np.asarray(before[name][()]).tobytes(), np.asarray(file[name][()]).tobytes(), name)
            self.assertEqual((file["poincare"].compression, file["poincare"].shuffle), ("gzip", True))
        verified = self.execute(None, "verify", tight, "--recompute", 5)
        self.assertEqual((verified.returncode, verified.stderr), (0, ""))
        maps = []
        for name in ("loose", "tight"):
            job = self.execute(None, "analyse", f"{name}.h5", "-o", f"{name}_maps.h5")
            self.assertEqual(job.returncode, 0, job.stderr)
            # They contain the name of their atlas.
            maps.append((self.directory / f"{name}_maps.h5").read_bytes().replace(name.encode(), b"atlas"))
        self.assertTrue(maps[0] == maps[1], "maps of the packed atlas differ")
        # Unpacked again, and packed again.
        self.assertEqual(self.merge(["tight.h5"], "merged.h5").returncode, 0)
        self.assert_same_bytes(loose, self.directory / "merged.h5")
        self.assertEqual(self.pack("merged.h5", "-o", "again.h5").returncode, 0)
        self.assertTrue(tight.read_bytes() == (self.directory / "again.h5").read_bytes())

    def test_large_rows_become_smaller(self):
        content = scene(grid={"speed_ratio": {"from": 0.1, "to": 0.9, "count": 20}, "damping_ratio": [0.1, 0.2]},
                        observables=["poincare", "spectrum"])
        content["protocol"]["sampled_revolutions"] = 60
        loose = self.fill(None, content, "loose.h5")
        self.assertEqual(self.pack("loose.h5", "-o", "packed.h5").returncode, 0)
        self.assertLess((self.directory / "packed.h5").stat().st_size, 0.95 * loose.stat().st_size)

    def test_no_run_goes_on_with_a_packed_atlas(self):
        names = self.parts(five_lines(), 2)
        self.assertEqual(self.pack(names[0], "-o", "packed.h5").returncode, 0)
        before = (self.directory / "packed.h5").read_bytes()
        job = self.execute(2, "run", "scene.json", "-o", "packed.h5", "--resume")
        self.assert_refused(job, 2, "packed.h5 is packed and takes no more rows")
        self.assertEqual((self.directory / "packed.h5").read_bytes(), before)
        self.assert_merged(self.fill(None, five_lines(), "whole.h5"), ["packed.h5", names[1]])

    def test_pack_refuses_what_every_command_refuses(self):
        self.fill(None, five_lines(), "whole.h5")
        (self.directory / "letter.h5").write_text("a letter")
        before = self.names()
        self.assert_refused(self.pack("whole.h5", "-o", "whole.h5", "--overwrite"), 2, "the same file")
        self.assert_refused(self.pack("whole.h5", "-o", "letter.h5"), 2, "letter.h5 exists; --overwrite replaces it")
        self.assert_refused(self.pack("whole.h5", "-o", "letter.h5", "--overwrite"), 2,
                            "letter.h5 is no file of rubatlas")
        self.assert_refused(self.pack("letter.h5", "-o", "packed.h5"), 3, "letter.h5", "cannot be opened")
        with h5py.File(self.directory / "whole.h5", "r+") as file:
            file["final_state"][0, 0, 0, 4, 5, 0] += 1e-9
        self.assert_refused(self.pack("whole.h5", "-o", "packed.h5"), 3,
                            "whole.h5 is damaged: the row at speed_ratio=0.9")
        self.assertEqual(self.names(), before)

    def test_damage_in_a_packed_atlas_is_found(self):
        self.fill(None, five_lines(), "whole.h5")
        self.assertEqual(self.pack("whole.h5", "-o", "packed.h5").returncode, 0)
        packed = self.directory / "packed.h5"
        with h5py.File(packed) as file:
            place = file["poincare"].id.get_chunk_info(0).byte_offset + 40
        content = bytearray(packed.read_bytes())
        content[place] ^= 1
        packed.write_bytes(content)
        job = self.execute(None, "verify", "packed.h5")
        self.assertEqual(job.returncode, 3)
        self.assertIn("packed.h5", job.stderr)


if __name__ == "__main__":
    unittest.main()

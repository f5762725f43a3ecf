"""What happens to files: which outputs are refused, how damaged and foreign ones are met, what a job leaves."""
import json
import os
import random
import resource
import shutil
import struct
import subprocess
import unittest
import zlib

import h5py
import numpy as np

from job import AT_ITS_END, ENVIRONMENT, JobTest, command, long_scene, scene, wait_for_points

POINT = "speed_ratio=0.2,damping_ratio=0.1"


def seal(atlas):
    """Gives the bytes besides the rows the checksum that they have now (src/atlas/header_checksum.hpp)."""
    content = bytearray(atlas.read_bytes())
    mark = b"rubatlas header\n"
    place = content.index(mark) + len(mark)
    count, = struct.unpack_from("<I", content, place + 4)
    rows = [struct.unpack_from("<QQ", content, place + 8 + 16 * number) for number in range(count)]
    checksum, at = 0, 0
    for begin, end in sorted([*rows, (20, 24), (place, place + 4)]):
        checksum, at = zlib.crc32(content[at:begin], checksum), end
    struct.pack_into("<I", content, place, zlib.crc32(content[at:], checksum))
    atlas.write_bytes(content)


class FileTest(JobTest):
    def assert_one_sentence(self, job, name, codes=(3,)):
        """One sentence that names the file and nothing of the library or of our sources."""
        said = job.stderr.splitlines()
        self.assertEqual(len(said), 1, job.stderr)
        self.assertTrue(said[0].startswith("rubatlas: ") and name in said[0], job.stderr)
        for internal in ("HDF5", "H5", "src/", ".cpp", "errno"):
            self.assertNotIn(internal, said[0].replace(".h5", ""))
        self.assertIn(job.returncode, codes, job.stderr)

    def readers(self, name):
        """Everybody who reads an atlas: arguments of the program."""
        return [("run", "scene.json", "-o", name, "--resume", "--progress", "off"), ("analyse", name, "-o", "maps.h5"),
                ("orbit", "scene.json", "--at", POINT, "--from", name, "-o", "orbit.h5"), ("verify", name)]


class Outputs(FileTest):
    def test_a_scene_is_never_replaced_by_its_atlas(self):
        path = self.write_scene(scene())
        before = path.read_text()
        os.link(path, self.directory / "link.json")
        for output in ("scene.json", "link.json"):
            job = self.execute(2, "run", path, "-o", output, "--overwrite")
            self.assert_refused(job, 2, "the same file")
        self.assertEqual(path.read_text(), before)

    def test_a_record_of_runs_replaces_no_other_file(self):
        path = self.write_scene(scene(), "a.h5.run.json")
        before = path.read_text()
        self.assert_refused(self.execute(None, "run", path, "-o", "a.h5"), 2, "the same file")
        self.assertEqual(path.read_text(), before)
        other = self.write_scene(scene())
        self.assert_refused(self.execute(None, "run", other, "-o", "a.h5"), 2, "a.h5.run.json is no file of rubatlas")
        self.assertEqual(path.read_text(), before)

    def test_a_device_stays_one(self):
        job = self.execute(None, "run", self.write_scene(scene()), "-o", "/dev/null", "--overwrite")
        self.assert_refused(job, 2, "/dev/null is a device")
        self.assertFalse(os.path.isfile("/dev/null"))

    def test_maps_and_tables_are_replaced_by_maps_and_tables_when_asked(self):
        atlas = self.fill(None, scene())
        arguments = ("analyse", atlas.name, "-o", "maps.h5", "--table", "table.md")
        self.assertEqual(self.execute(None, *arguments).returncode, 0)
        self.assert_refused(self.execute(None, *arguments), 2, "maps.h5 exists", "--overwrite")
        self.assertEqual(self.execute(None, *arguments, "--overwrite").returncode, 0)
        before = atlas.read_bytes()
        for wrong in (("-o", atlas.name), ("-o", "scene.json"), ("-o", "table.md"),
                      ("-o", "maps.h5", "--table", "maps.h5"),
                      ("-o", "maps.h5", "--table", "scene.json")):
            job = self.execute(None, "analyse", atlas.name, *wrong, "--overwrite")
            self.assert_refused(job, 2)
        self.assertEqual(atlas.read_bytes(), before)
        self.assertEqual(json.loads((self.directory / "scene.json").read_text())["title"], "short lines")

    def test_a_folder_that_is_not_there_is_told_before_anything_is_written(self):
        atlas = self.fill(None, scene())
        before = sorted(os.listdir(self.directory))
        for arguments in (("analyse", atlas.name, "-o", "maps.h5", "--table", "nowhere/table.md"),
                          ("orbit", "scene.json", "--at", POINT, "-o", "nowhere/o.h5"),
                          ("run", "scene.json", "-o", "nowhere/a.h5")):
            self.assert_refused(self.execute(None, *arguments), 3, f"cannot write {arguments[-1]}: No such file")
        self.assertEqual(sorted(os.listdir(self.directory)), before)

    def test_nothing_is_left_beside_an_output_that_failed(self):
        self.write_scene(scene())
        size = self.fill(None, scene(), "whole.h5").stat().st_size
        before = sorted(os.listdir(self.directory))

        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (size - 2000, size - 2000))  # more than its rows take
        for arguments in (("run", "scene.json", "-o", "a.h5"), ("orbit", "scene.json", "--at", POINT, "-o", "o.h5")):
            job = subprocess.run(command(None, *arguments), cwd=self.directory, preexec_fn=limit, text=True,
                                 capture_output=True, check=False)
            if arguments[0] == "run":
                self.assert_one_sentence(job, "File too large")
        self.assertEqual([name for name in sorted(os.listdir(self.directory)) if name != "o.h5"], before)

    def test_a_hard_link_does_not_let_a_second_run_in(self):
        atlas = self.directory / "atlas.h5"
        first = self.start(2, long_scene(), atlas)
        wait_for_points(first, atlas, 1)
        os.link(atlas, self.directory / "link.h5")
        second = self.execute(None, "run", "scene.json", "-o", "link.h5", "--resume")
        self.assert_refused(second, 3, "another run is filling link.h5")
        first.kill()

    def test_an_atlas_that_is_taken_away_under_a_run_is_not_reported_as_done(self):
        for ranks, change in ((None, os.unlink), (2, lambda path: os.rename(path, self.directory / "elsewhere.h5"))):
            atlas = self.directory / "atlas.h5"
            job = self.start(ranks, {**long_scene(), "grid": scene()["grid"]}, atlas, **AT_ITS_END)
            wait_for_points(job, atlas, 1)
            change(atlas)
            message = job.communicate(timeout=120)[1]
            self.assertIn("atlas.h5 was removed, moved or replaced while it was being filled", message)
            self.assertEqual(job.returncode, 3)

    def test_closed_descriptors_do_not_come_back_as_files(self):
        whole = self.fill(None, scene(), "whole.h5")
        run = " ".join(command(None, "run", "scene.json", "-o", "closed.h5", "--progress", "plain"))
        for closed in ("2>&-", "0<&- 1>&- 2>&-"):
            (self.directory / "closed.h5").unlink(missing_ok=True)
            job = subprocess.run(["bash", "-c", f"exec {run} {closed}"], cwd=self.directory, check=False)
            self.assertEqual(job.returncode, 0)
            self.assert_same_bytes(whole, self.directory / "closed.h5")

    def test_a_title_steers_no_terminal(self):
        self.fill(None, scene(title="red \u001b[31m bell \u0007 next \u009b line \n end"))
        for arguments in (("explain", "scene.json", "--measure", "0"), ("analyse", "atlas.h5", "-o", "maps.h5")):
            self.assertTrue(self.execute(None, *arguments).stdout.startswith("red [31m bell  next  line  end\n"))


SETTLES_NEVER = {**scene()["protocol"], "settle": "never"}


class Damage(FileTest):
    def setUp(self):
        super().setUp()
        self.atlas = self.fill(None, scene(sweep="up"))

    def damaged(self, change):
        """A copy of the atlas that `change` has had open."""
        shutil.copy(self.atlas, self.directory / "bad.h5")
        with h5py.File(self.directory / "bad.h5", "r+") as file:
            change(file)

    def test_a_dataset_that_is_not_as_its_scene_asks_for_is_refused_by_all(self):
        def replace(name, **kind):
            def change(file):
                del file[name]
                file.create_dataset(name, **kind)
            return change

        def shift_axis(file):
            file["speed_ratio"][3] += 1e-3

        def external(file):
            del file["poincare"]
            file["poincare"] = h5py.ExternalLink("atlas.h5", "/poincare")

        def soft(file):
            file.move("poincare", "other")
            file["poincare"] = h5py.SoftLink("/nowhere")

        def set_to(name, place, value):
            def change(file):
                file[name][place] = value
            return change

        def set_scene(text):
            def change(file):
                del file["scene_resolved"]
                file["scene_resolved"] = text
            return change

        shape = (1, 1, 1, 3, 12)
        cases = {
            "/status": [replace("status", data=np.uint8(1)), replace("status", data=np.zeros(shape)),
                        replace("status", data=np.zeros((3, 12), np.uint8)), replace("status", data=b"text"),
                        set_to("status", (0, 0, 0, 1, 4), 7),
                        lambda file: file["status"].dims[4].detach_scale(file["speed_ratio"])],
            "/poincare": [replace("poincare", data=b"a text"), replace("poincare", data=np.zeros((*shape, 8, 3))),
                          replace("poincare", data=np.zeros((*shape, 8, 4), np.float32)), external, soft,
                          lambda file: file["poincare"].dims[5].detach_scale(file["section"]),
                          replace("poincare", shape=(*shape, 8, 4), dtype="<f8", external=[("rows.bin", 0, 10**6)])],
            "/final_state": [set_to("final_state", (0, 0, 0, 2, 3, 1), np.nan),
                             replace("final_state", data=np.zeros(4))],
            "/speed_ratio": [shift_axis, lambda file: file.__delitem__("speed_ratio"),
                             replace("speed_ratio", data=np.zeros(11))],
            "/scene_resolved": [set_scene("no JSON"), set_scene("{}"), set_scene("[1]")],
            "/row_checksum": [lambda file: file.__delitem__("row_checksum"),
                              replace("row_checksum", data=np.zeros(shape))],
        }
        for name, changes in cases.items():
            for number, change in enumerate(changes):
                self.damaged(change)
                for arguments in self.readers("bad.h5"):
                    with self.subTest(name=name, number=number, command=arguments[0]):
                        job = self.execute(None, *arguments)
                        self.assert_one_sentence(job, "bad.h5")
                        self.assertIn(name, job.stderr)
        self.assertFalse((self.directory / "maps.h5").exists() or (self.directory / "orbit.h5").exists())

    def test_a_file_of_another_kind_is_no_atlas(self):
        self.assertEqual(self.execute(None, "analyse", "atlas.h5", "-o", "maps_of_it.h5").returncode, 0)
        (self.directory / "letter.h5").write_text("a letter")
        (self.directory / "empty.h5").write_text("")
        (self.directory / "short.h5").write_bytes(self.atlas.read_bytes()[:20000])
        (self.directory / "folder.h5").mkdir()
        for name in ("letter.h5", "empty.h5", "short.h5", "folder.h5", "maps_of_it.h5", "missing.h5"):
            for arguments in self.readers(name)[0 if name not in ("folder.h5", "missing.h5") else 1:]:
                with self.subTest(name=name, command=arguments[0]):
                    code = 2 if name == "maps_of_it.h5" else 3
                    self.assert_one_sentence(self.execute(None, *arguments), name, codes=(code,))

    def test_random_bytes_are_found_wherever_they_are(self):
        whole, chance, accepted = self.atlas.read_bytes(), random.Random(3), []
        with h5py.File(self.atlas, "r") as file:
            # A point may become pending, which is no damage; and nobody looks at HDF5's flags of open files.
            begin = file["status"].id.get_offset()
            harmless = {*range(20, 24), *range(begin, begin + file["status"].size)}
        # A few through the program itself; the suite command_line has a hundred within one process.
        for trial in range(12):
            bytes_ = bytearray(whole)
            for _ in range(chance.choice((1, 1, 8))):
                place = chance.randrange(len(whole))
                while place in harmless:
                    place = chance.randrange(len(whole))
                bytes_[place] ^= chance.randrange(1, 256)
            (self.directory / "bad.h5").write_bytes(bytes_)
            (self.directory / "maps.h5").unlink(missing_ok=True)
            resume, analyse, verify = (self.execute(None, *arguments) for arguments in self.readers("bad.h5")
                                       if arguments[0] != "orbit")
            with self.subTest(trial=trial):
                self.assert_one_sentence(resume, "bad.h5")
                self.assertEqual(verify.returncode, 3, verify.stderr)
                self.assertTrue(all(line.startswith("rubatlas: ") for line in verify.stderr.splitlines()))
                if analyse.returncode != 0:
                    self.assert_one_sentence(analyse, "bad.h5")
                else:
                    accepted.append(trial)
        self.assertLess(len(accepted), 12, "rows at least are looked at")

    def test_resuming_refuses_rows_that_are_not_what_was_computed(self):
        def change(file):
            file["status"][0, 0, 0, :, 6:] = 0
            file["final_state"][0, 0, 0, 1, 5, 0] += 1e-12
        self.damaged(change)
        job = self.execute(2, "run", "scene.json", "-o", "bad.h5", "--resume")
        self.assert_refused(job, 3,
                            "bad.h5 is damaged: the row at speed_ratio=0.5181818181818182, damping_ratio=0.15 "
                            "does not have its checksum")

    def test_an_atlas_of_the_version_before_goes_on_by_the_method_that_it_names(self):
        by_hybrid = scene(sweep="up", accuracy={"method": "hybrid"}, protocol=SETTLES_NEVER)
        whole = self.fill(None, by_hybrid, name="whole.h5")
        atlas = self.fill(None, by_hybrid, name="before.h5")
        with h5py.File(atlas, "r+") as file:
            file.attrs["schema_version"] = "2"
            self.assertNotIn("settled", file)
            file["status"][0, 0, 0, :, 6:] = 0
        seal(atlas)
        self.fill(None, by_hybrid, atlas.name, "--resume")
        with h5py.File(whole) as expected, h5py.File(atlas) as resumed:
            np.testing.assert_array_equal(resumed["poincare"][...], expected["poincare"][...])

    def test_an_atlas_without_checksums_is_read_and_not_resumed(self):
        def change(file):
            file.attrs["schema_version"] = "1"
            del file["row_checksum"], file.attrs["header_checksum"], file.attrs["kind"]
        self.damaged(change)
        _, _, orbit, _ = self.readers("bad.h5")
        self.assert_refused(self.execute(None, *orbit), 2,
                            '/protocol/settle is "never" in the first and "newton" in the second')
        (self.directory / "scene.json").write_text(json.dumps(scene(sweep="up", protocol=SETTLES_NEVER)))
        resume, analyse, orbit, verify = (self.execute(None, *arguments) for arguments in self.readers("bad.h5"))
        self.assertEqual((analyse.returncode, orbit.returncode), (0, 0), analyse.stderr + orbit.stderr)
        self.assert_one_sentence(resume, "bad.h5")
        self.assert_one_sentence(verify, "bad.h5")
        self.assertIn("no checksums", resume.stderr + verify.stderr)


class Verify(FileTest):
    def test_a_finished_and_an_unfinished_atlas_pass(self):
        self.fill(2, scene(sweep="both"))
        job = self.execute(None, "verify", "atlas.h5", "--recompute", "7")
        self.assertEqual((job.returncode, job.stderr), (0, ""))
        self.assertEqual(job.stdout, "atlas.h5: 72 of 72 points have rows, and 72 of these have their checksum; "
                                     "7 of 7 computed again have the same bits\n")

    def test_points_outside_the_model_are_verified_like_all_others(self):
        self.fill(None,
                  scene(sweep="up", grid={"speed_ratio": {"from": 0.2, "to": 1.2, "count": 12}, "damping_ratio": 0.02}))
        job = self.execute(None, "verify", "atlas.h5", "--recompute", "100")
        self.assertEqual((job.returncode, job.stderr), (0, ""))
        self.assertIn("12 of 12 computed again", job.stdout)

    def test_a_row_that_was_exchanged_with_its_checksum_is_found_by_computing_it_again(self):
        atlas = self.fill(None, scene(sweep="down"))
        with h5py.File(atlas, "r+") as file:
            place = (0, 0, 0, 2, 5)
            file["max_displacement"][place] *= 1.0 + 1e-15
            sums = file["row_checksum"]
            sums[place] = zlib.crc32(b"".join(file[name][place].tobytes() for name in sums.attrs["order"].split()))
        job = self.execute(None, "verify", "atlas.h5")
        self.assertNotIn("does not have its checksum", job.stderr)
        job = self.execute(None, "verify", "atlas.h5", "--recompute", "36")
        self.assertEqual(job.returncode, 3)
        self.assertRegex(job.stderr,
                         r"computed again, the row at speed_ratio=[0-9.]+, damping_ratio=0.2 differs in "
                         r"/max_displacement\n")
        self.assertIn("35 of 36 computed again have the same bits", job.stdout)

    def test_many_damaged_rows_are_counted(self):
        atlas = self.fill(None, scene())
        with h5py.File(atlas, "r+") as file:
            file["spectrum"][..., 3] += 1.0
        job = self.execute(None, "verify", "atlas.h5")
        self.assertEqual(job.returncode, 3)
        self.assertEqual(job.stderr.count("does not have its checksum"), 10)
        self.assertIn("... and 26 more rows", job.stderr)
        self.assertIn("36 of 36 points have rows, and 0 of these have their checksum", job.stdout)


if __name__ == "__main__":
    unittest.main()

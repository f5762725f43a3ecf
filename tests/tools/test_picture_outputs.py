"""What a picture may be called, and what it may replace."""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
TINY = pathlib.Path(os.environ["RUBATLAS_PROGRAM"]).parent / "tests/tiny_atlas"
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tests/support")]
from forked_commands import ended_command  # noqa: E402


class ToolsOutputs(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def expect_refusal(self, output, sentence, tool="displacement", source=TINY / "atlas.h5", arguments=()):
        ended = ended_command("rubatlas-plot", tool, source, *arguments, "-o", output)
        self.assertEqual((ended.returncode, ended.stdout), (2, ""), ended.stderr)
        self.assertRegex(ended.stderr, rf"^rubatlas-plot {tool}: .*{sentence}.*\n$")
        self.assertEqual(ended.stderr.count("\n"), 1, ended.stderr)

    def test_numbers_that_draw_nothing_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            output = pathlib.Path(folder) / "picture.png"
            for tool, source, option, values in (("displacement", "atlas.h5", "--dpi", ("1", "1e9")),
                                                 ("waterfall", "atlas.h5", "--max_frequency", ("inf",)),
                                                 ("orbit", "orbit.h5", "--revolutions", ("1.5", "1e9"))):
                for value in ("0", "-2", "nan", *values):
                    with self.subTest(option + value):
                        self.expect_refusal(output, f"{option}: {value} is no .* number ", tool, TINY / source,
                                            [f"{option}={value}"])
                        self.assertFalse(output.exists())

    def test_a_mistaken_argument_is_one_sentence(self):
        for arguments, sentence in ((["--of", "x"], "unrecognized arguments: --of x"), (["--dpi"], "--dpi: expected"),
                                    (["--zoom", "1"], "--zoom: 1 is no range")):
            self.expect_refusal(self.folder / "a.png", sentence, "bifurcation", arguments=arguments)
        ended = ended_command("rubatlas-report", TINY / "atlas.h5", "--orbits", "few")
        self.assertEqual((ended.returncode, ended.stderr),
                         (2, "rubatlas-report: argument --orbits: few is no whole number\n"))

    def test_a_command_whose_output_nobody_reads_ends_without_a_word(self):
        for command, *arguments in (("rubatlas-plot", "--help"), ("rubatlas-plot", "map", "--help"),
                                    ("rubatlas-plot", "accuracy", TINY / "accuracy.h5", "-o", self.folder),
                                    ("rubatlas-report", "--help")):
            reader, writer = os.pipe()
            os.close(reader)
            ended = subprocess.run([ROOT / "tools" / command, *arguments], stdout=writer, stderr=subprocess.PIPE,
                                   text=True, check=False)
            os.close(writer)
            self.assertEqual((ended.returncode, ended.stderr), (-signal.SIGPIPE, ""))

    def test_a_damaged_atlas_is_no_mistake_of_the_call(self):
        whole = (TINY / "atlas.h5").read_bytes()
        for content in (whole[:len(whole) // 2], b"", whole.replace(b'"natural_frequency"', b'"natural_frequence"')):
            path = self.folder / "damaged.h5"
            path.write_bytes(content)
            ended = ended_command("rubatlas-plot", "displacement", path, "-o", self.folder / "a.png")
            self.assertEqual((ended.returncode, ended.stderr.count("\n")), (3, 1), ended.stderr)
            self.assertIn("damaged", ended.stderr)

    def test_a_scene_or_maps_in_place_of_an_atlas_are_a_mistake_of_the_call(self):
        scene = ROOT / "tests/tools/tiny.json"
        output, wanted = self.folder / "a.png", f"{scene}: a text in braces, such as a scene, where atlas or maps is"
        self.expect_refusal(output, wanted, source=scene)
        self.expect_refusal(output, wanted, "map", arguments=["--maps", scene])
        self.expect_refusal(output, "such as a scene, where orbit is wanted", "orbit", scene)
        self.expect_refusal(self.folder / "all", "no /status; these are the maps of an atlas", "all", TINY / "maps.h5")
        ended = ended_command("rubatlas-report", scene, "-o", self.folder / "a.html")
        self.assertEqual((ended.returncode, ended.stderr), (2, f"rubatlas-report: {wanted} wanted\n"))
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_an_unknown_ending_is_refused(self):
        for name in ("a.jpeg", "a", "a.h5"):
            self.expect_refusal(self.folder / name, "a picture ends in .png, .pdf, .svg")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_missing_folder_is_refused(self):
        self.expect_refusal(self.folder / "none/a.png", "there is no folder")

    def test_pictures_of_all_kinds_replace_pictures_with_the_same_bytes(self):
        for kind in ("png", "svg", "pdf"):
            path = self.folder / f"a.{kind}"
            contents = []
            for _ in range(2):
                ended = ended_command("rubatlas-plot", "displacement", TINY / "atlas.h5", "--dpi", 50, "-o", path)
                self.assertEqual(ended.returncode, 0)
                contents.append(path.read_bytes())
            self.assertEqual(contents[0], contents[1], kind)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["a.pdf", "a.png", "a.svg"])

    def test_a_file_that_is_no_picture_is_kept_whatever_its_name(self):
        for name, content in (("notes.png", b"my notes"), ("empty.svg", b""),
                              ("data.svg", b"<?xml version='1.0'?><data/>")):
            path = self.folder / name
            path.write_bytes(content)
            self.expect_refusal(path, "is no picture; a picture replaces pictures only")
            self.assertEqual(path.read_bytes(), content)
        (self.folder / "folder.png").mkdir()
        self.expect_refusal(self.folder / "folder.png", "no file that a picture could replace")

    def test_the_input_is_never_replaced(self):
        own = self.folder / "atlas.png"
        own.write_bytes((TINY / "atlas.h5").read_bytes())
        self.expect_refusal(own, "would replace .*, which it is made from", source=own)
        link = self.folder / "link.png"
        link.hardlink_to(own)
        self.expect_refusal(link, "would replace .*, which it is made from", source=own)
        self.assertEqual(own.read_bytes(), (TINY / "atlas.h5").read_bytes())

    def test_a_study_of_accuracy_keeps_other_files_too(self):
        (self.folder / "accuracy.png").write_text("my notes")
        ended = ended_command("rubatlas-plot", "accuracy", TINY / "accuracy.h5", "-o", self.folder)
        self.assertEqual(ended.returncode, 2)
        self.assertRegex(ended.stderr, r"^rubatlas-plot accuracy: .*is no picture.*\n$")
        (self.folder / "file").write_text("")
        ended = ended_command("rubatlas-plot", "accuracy", TINY / "accuracy.h5", "-o", self.folder / "file")
        self.assertEqual((ended.returncode, ended.stderr.count("\n")), (3, 1), ended.stderr)


if __name__ == "__main__":
    unittest.main()

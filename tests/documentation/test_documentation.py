"""What the READMEs tell a user to type is typed here: every command and every snippet runs, in the order of the page.

A block that cannot run in a test stands below a comment that says why: <!-- not run: reason -->
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))

from forked_commands import ended_script  # noqa: E402
from mpi_environment import CROWDED  # noqa: E402

import rubatlas.atlas  # noqa: E402, F401  # with xarray, which scripts then find imported

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
PROGRAM = pathlib.Path(os.environ["RUBATLAS_PROGRAM"])
TINY = PROGRAM.parent / "tests/tiny_atlas"

BLOCK = re.compile(r"(?:^<!-- not run: (?P<reason>[^>]+) -->\n)?^```(?P<language>\w+)\n(?P<text>.*?)^```", re.M | re.S)
RUNS = ("sh", "python")
ENVIRONMENT = {**CROWDED, "MPLBACKEND": "Agg"}
SHORT = {"transient_revolutions": 20, "sampled_revolutions": 16}


def ended(language, text, folder):
    """A block of a page, carried out in the folder."""
    if language == "python":
        return ended_script(text, folder, ENVIRONMENT)
    return subprocess.run(["bash", "-euo", "pipefail", "-c", text], cwd=folder, env=ENVIRONMENT,
                          stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)


def clone(folder):
    """A folder that looks like a clone after quickstart, with the tiny atlas in the place of its result."""
    for name in ("tools", "tests", "analysis"):
        (folder / name).symlink_to(ROOT / name)
    (folder / "jobs").mkdir()
    for path in (ROOT / "jobs").iterdir():
        if path.suffix == ".json":
            # Of few revolutions, of which a page says nothing: they take a tenth of the time.
            scene = json.loads(path.read_text())
            scene["protocol"] = {**scene.get("protocol", {}), **SHORT}
            (folder / "jobs" / path.name).write_text(json.dumps(scene, indent=2))
        else:
            (folder / "jobs" / path.name).symlink_to(path)
    (folder / "build").mkdir()
    (folder / "build" / "rubatlas").symlink_to(PROGRAM)
    (folder / "atlases").mkdir()
    shutil.copy(TINY / "atlas.h5", folder / "atlases" / "quick.h5")
    shutil.copy(TINY / "maps.h5", folder / "atlases" / "quick_maps.h5")
    for name in ("basins.h5", "basins_maps.h5"):
        shutil.copy(TINY / name, folder / "atlases")


def user_pages():
    """Every page that is not the tests' own."""
    return [page for page in sorted(ROOT.rglob("*.md"))
            if not page.relative_to(ROOT).parts[0].startswith(("build", ".", "tests", "atlases"))]


class PageTest(unittest.TestCase):
    """A test that does what a page says."""

    def expect_blocks_run(self, page, at_least):
        blocks = list(BLOCK.finditer((ROOT / page).read_text()))
        ran = 0
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            clone(folder)
            for block in blocks:
                if block["reason"] or block["language"] not in RUNS:
                    continue
                with self.subTest(block=block["text"]):
                    end = ended(block["language"], block["text"], folder)
                    self.assertEqual(end.returncode, 0, end.stdout[-2000:] + end.stderr[-2000:])
                ran += 1
        self.assertGreaterEqual(ran, at_least, f"{page} has {len(blocks)} blocks, of which {ran} ran")


class Documentation(PageTest):
    def test_every_block_of_the_readme_runs(self):
        self.expect_blocks_run("README.md", at_least=4)

    def test_every_block_of_the_tools_readme_runs(self):
        self.expect_blocks_run("tools/README.md", at_least=3)

    def test_every_block_of_the_tutorial_runs(self):
        self.expect_blocks_run("jobs/tutorial.md", at_least=6)

    def test_every_block_of_the_page_of_maps_runs(self):
        self.expect_blocks_run("analysis/maps.md", at_least=1)

    def test_every_block_of_the_page_of_the_judge_runs(self):
        self.expect_blocks_run("analysis/paper/README.md", at_least=1)

    def test_every_block_of_the_report_readme_runs(self):
        self.expect_blocks_run("tools/rubatlas/report/README.md", at_least=1)

    def test_no_two_pages_write_the_same_file(self):
        writers = {}
        for page in user_pages():
            for block in BLOCK.finditer(page.read_text()):
                for line in block["text"].replace("\\\n", " ").splitlines():
                    written = re.search(r"build/rubatlas .* -o ([^\s$]+\.h5)", line)  # of names without a variable
                    if written and "--resume" not in line:
                        writers.setdefault(written[1], set()).add(str(page.relative_to(ROOT)))
        self.assertGreater(len(writers), 15)
        self.assertEqual({name: pages for name, pages in writers.items() if len(pages) > 1}, {})

    def test_a_command_that_draws_names_what_it_draws(self):
        named = 0
        for source in [*user_pages(), *(ROOT / "analysis").rglob("*.cpp"), *(ROOT / "mpi").rglob("*.cpp")]:
            for mention in re.finditer(r"rubatlas-plot ([a-z_]+)\b(.*)", source.read_text().replace("\\\n", " ")):
                with self.subTest(source=str(source), mention=mention[0]):
                    self.assertRegex(mention[2].split("`")[0], r"^ \S*(\.h5|build/rubatlas)\b.* -o ")
                named += 1
        self.assertGreater(named, 30)

    def test_a_table_with_aperiodic_motion_says_that_its_last_digits_depend_on_the_processor(self):
        page = (ROOT / "README.md").read_text()
        of_table = re.compile(r"region 2.*\n.*\n.* [1-9]\d* %, ")
        tables = [block for block in BLOCK.finditer(page) if of_table.search(block["text"])]
        self.assertEqual(len(tables), 1)
        for table in tables:
            below = " ".join(page[table.end():].split("\n\n")[1].split())
            self.assertIn("last digits of aperiodic figures depend on the processor", below)

    def test_other_languages_are_marked_or_plain(self):
        for page in sorted(ROOT.rglob("*.md")):
            if any(part.startswith(("build", ".")) or part == "atlases" for part in page.relative_to(ROOT).parts):
                continue
            for block in BLOCK.finditer(page.read_text()):
                with self.subTest(page=str(page), block=block["text"][:60]):
                    self.assertIn(block["language"], {*RUNS, "text", "json", "bibtex", "cpp", "mermaid"})

    def test_every_scene_in_jobs_is_accepted(self):
        scenes = sorted((ROOT / "jobs").glob("*.json"))
        self.assertGreaterEqual(len(scenes), 12)
        for scene in scenes:
            with self.subTest(scene=scene.name):
                ended = subprocess.run([PROGRAM, "explain", scene, "--measure", "0.01"], capture_output=True, text=True,
                                       check=False)
                self.assertEqual((ended.returncode, ended.stderr), (0, ""))
                self.assertTrue(ended.stdout.strip())

    def test_every_scene_in_jobs_says_what_it_is_and_where_from(self):
        for scene in sorted((ROOT / "jobs").glob("*.json")):
            with self.subTest(scene=scene.name):
                content = json.loads(scene.read_text())
                self.assertTrue(content["title"] and content["reference"])
                kept = "poincare_blade_passing" in content["observables"]
                unbalance = content["grid"].get("unbalance", [] if "unbalance" in content else [0.0])
                if unbalance == [0.0]:
                    self.assertTrue(kept)
                elif kept:  # for the lines without unbalance
                    self.assertIn(0.0, unbalance)

    def test_every_study_comes_with_both_contact_laws(self):
        for study in ("default", "damping", "friction", "unbalance", "thickness"):
            with self.subTest(study=study):
                flexible = json.loads((ROOT / f"jobs/{study}.json").read_text())
                rigid = json.loads((ROOT / f"jobs/{study}_elastic_ring.json").read_text())
                self.assertEqual((flexible["contact"]["law"], rigid["contact"]["law"]), ("elastica", "elastic_ring"))
                self.assertEqual(flexible["grid"], rigid["grid"])
                speed = flexible["grid"]["speed_ratio"]
                self.assertEqual((speed["from"], speed["to"], speed["count"]), (0.05, 0.95, 1000))

    def test_the_jobs_readme_lists_every_scene(self):
        page = (ROOT / "jobs/README.md").read_text()
        for scene in sorted((ROOT / "jobs").glob("*.json")):
            flexible = scene.stem.removesuffix("_elastic_ring")  # one line of the table stands for both laws
            both = (ROOT / "jobs" / f"{flexible}.json").exists()
            self.assertIn(f"`{flexible if both else scene.stem}.json`", page)


class GallerySlow(PageTest):
    """Slow: a minute for commands of which README, tutorial and the tests of pictures run every kind."""

    def test_every_block_of_the_gallery_runs(self):
        self.expect_blocks_run("tools/gallery.md", at_least=10)


if __name__ == "__main__":
    unittest.main()

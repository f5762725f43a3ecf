"""What `rubatlas-report` writes and what it refuses."""
import json
import os
import pathlib
import re
import sys
import tempfile
import unittest

from unittest import mock

import h5py
import numpy as np
from reports import ROOT, SOLVER, TINY, made, report, run, tiny

sys.path.insert(0, str(ROOT / "tools"))

from rubatlas.atlas_file import AtlasError, AtlasFile  # noqa: E402
from rubatlas.report import contents  # noqa: E402

FOLDER = ROOT / "tools/rubatlas/report"


class Report(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def expect_refusal(self, words, *arguments):
        ended = report(*arguments)
        self.assertEqual(ended.returncode, 2, ended.stderr)
        self.assertIn(words, ended.stderr)
        self.assertEqual(len(ended.stderr.strip().splitlines()), 1, ended.stderr)

    def test_a_report_refers_to_nothing_outside_of_itself(self):
        content = tiny(self.folder).read_text()
        self.assertEqual(re.findall(r"<(?:link|iframe|img|object|embed|base)\b|\ssrc=|\shref=\"http|@import|url\((?!#)",
                                    content), [])
        self.assertIn("default-src 'none'", content)

    def test_a_report_replaces_a_report_and_no_other_file(self):
        path = tiny(self.folder)
        tiny(self.folder)
        path.write_text("a letter")
        self.expect_refusal("is no report", TINY / "atlas.h5", "-o", path)
        self.assertEqual(path.read_text(), "a letter")

    def test_the_atlas_is_never_replaced_by_its_report(self):
        atlas = self.folder / "atlas.html"
        atlas.write_bytes((TINY / "atlas.h5").read_bytes())
        self.expect_refusal("which it is made from", atlas, "-o", atlas)

    def test_an_output_that_is_no_page_is_refused(self):
        self.expect_refusal("ends in .html", TINY / "atlas.h5", "-o", self.folder / "report.pdf")

    def test_an_output_in_a_folder_that_is_not_there_is_refused(self):
        self.expect_refusal("there is no folder", TINY / "atlas.h5", "-o", self.folder / "nowhere/report.html")

    def test_maps_of_another_scene_are_refused(self):
        self.expect_refusal("was not made from the scene", TINY / "atlas.h5", "--maps", TINY / "rings_maps.h5", "-o",
                            self.folder / "report.html")

    def test_maps_in_the_place_of_the_atlas_are_refused(self):
        self.expect_refusal("a report is made of an atlas", TINY / "maps.h5", "-o", self.folder / "report.html")

    def test_a_file_that_is_no_solver_is_refused(self):
        self.expect_refusal("not a WebAssembly module", TINY / "atlas.h5", "-o", self.folder / "report.html",
                            "--solver",
                            TINY / "table1.md")
        self.expect_refusal("no such file", TINY / "atlas.h5", "-o", self.folder / "report.html", "--solver",
                            self.folder / "no.wasm")

    def test_a_page_without_the_solver_has_the_orbits_of_the_program(self):
        with mock.patch.object(contents, "ORBITS", 8):
            ended = report(TINY / "gravity.h5", "-o", self.folder / "report.html", "--without-solver")
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertIn("made without the solver", ended.stdout)
        # Some motions leave the model after the revolutions that the atlas has sampled.
        orbits = int(re.search(r"(\d+) orbits", ended.stdout)[1])
        self.assertLessEqual(orbits, 8)
        self.assertGreater(orbits, 5)
        ended = report(TINY / "gravity.h5", "-o", self.folder / "report.html", "--without-solver", "--orbits", "3")
        self.assertIn(" 3 orbits", ended.stdout)

    def test_without_the_program_a_report_has_no_orbits_and_says_so(self):
        nothing = {"environment": {**os.environ, "RUBATLAS_PROGRAM": str(self.folder / "no_program")}}
        ended = report(TINY / "gravity.h5", "-o", self.folder / "report.html", "--without-solver", **nothing)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertIn("0 orbits", ended.stdout)
        self.assertIn("no_program", ended.stdout)
        ended = report(TINY / "gravity.h5", "-o", self.folder / "report.html", "--orbits", "3", **nothing)
        self.assertEqual(ended.returncode, 2)
        self.assertIn("no_program", ended.stderr)

    def test_a_report_keeps_what_every_effect_remembers_in_the_order_of_the_program(self):
        effects = ROOT / "src/settings/effects"
        order = re.findall(r"operator\(\)<&Effects::(\w+)>", (effects / "list.hpp").read_text())
        remember = {section for path in effects.glob("*.hpp") for part in path.read_text().split("struct ")
                    if "static constexpr Memory kMemory" in part
                    for section in re.findall(r'\.section = "/(\w+)"', part)}
        self.assertGreater(len(remember), 1)
        self.assertEqual([name for name in order if name in remember], list(contents.EFFECTS_THAT_REMEMBER))

    def test_a_number_of_orbits_is_a_whole_number(self):
        for word in ("-1", "some", "1.5"):
            ended = report(TINY / "atlas.h5", "-o", self.folder / "report.html", f"--orbits={word}")
            self.assertEqual(ended.returncode, 2)
            self.assertIn(f"--orbits: {word} is no whole number", ended.stderr)

    def test_as_many_sections_as_fit_are_kept(self):
        ended = report(TINY / "atlas.h5", "-o", self.folder / "report.html", *SOLVER)
        self.assertIn("16 of 16 sections", ended.stdout)

    def expect_size(self, most_bytes):
        """The sections that a report of the tiny atlas keeps with so many bytes for its numbers, and its bytes."""
        with mock.patch.object(contents, "MOST_BYTES", most_bytes), AtlasFile(TINY / "atlas.h5") as atlas:
            result, blocks = contents.contents(atlas, None, None, orbits=0)
        self.assertLessEqual(blocks.size, most_bytes)
        return result["lines"]["poincare"], blocks.size

    def test_sections_that_do_not_fit_are_left_out_from_the_first_on(self):
        # With a byte less than it takes a report has coarser spectra or half of the sections, in the end none.
        kept = []
        sections, size = self.expect_size(1_000_000)
        while sections is not None:
            kept.append(sections["sections"])
            sections, size = self.expect_size(size - 1)
        self.assertEqual(kept, sorted(kept, reverse=True))
        self.assertEqual(set(kept), {16, 8, 4, 2, 1})

    def test_an_atlas_that_is_too_large_is_refused(self):
        with self.assertRaisesRegex(AtlasError, "108 points are too many for one page"):
            self.expect_size(1000)

    def test_the_same_atlas_gives_the_same_bytes(self):
        first = tiny(self.folder).read_bytes()
        self.assertEqual(first, tiny(self.folder).read_bytes())

    def test_points_that_are_not_done_are_none_in_the_report(self):
        import base64
        import zlib
        content = made(self.folder / "report.html", TINY / "atlas.h5").read_text()
        atlas = json.loads(re.search(r'<script type="application/json" id="atlas">(.*?)</script>', content, re.S)[1])
        entry = next(one for one in atlas["maps"] if one["name"] == "max_displacement")
        block = re.search(f'data-block="{entry["block"]}">([^<]*)<', content)[1]
        shown = np.frombuffer(zlib.decompress(base64.b64decode(block)), dtype="<f8")
        with h5py.File(TINY / "atlas.h5") as file:
            done = file["status"][...].ravel() == 1
            self.assertGreater((~done).sum(), 0)
            np.testing.assert_array_equal(shown[done], file["max_displacement"][...].ravel()[done])
        self.assertTrue(np.isnan(shown[~done]).all())

    def test_the_plotting_library_is_the_one_of_the_lock_file(self):
        lock = json.loads((FOLDER / "vendor/package-lock.json").read_text())
        version = lock["packages"]["node_modules/uplot"]["version"]
        self.assertIn(f"(v{version})", (FOLDER / "vendor/uplot/uPlot.iife.min.js").read_text()[:200])
        self.assertTrue(lock["packages"]["node_modules/uplot"]["integrity"].startswith("sha512-"))

    def test_an_atlas_without_sections_and_spectra_has_a_report(self):
        atlas = run(self.folder, "plain", {"grid": {"speed_ratio": [0.3, 0.4]},
                                           "protocol": {"transient_revolutions": 2, "sampled_revolutions": 2},
                                           "observables": ["max_displacement"]})
        ended = report(atlas, "-o", self.folder / "report.html", "--without-solver")
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertIn("without sections", ended.stdout)


if __name__ == "__main__":
    unittest.main()

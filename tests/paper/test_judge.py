"""The commands `judge` and `statement_map`: what they print and write, and what they refuse."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np
from synthetic_lines import ROOT

from paper import statement_map
from paper.atlas_lines import AtlasLines
from paper.line import region_text
from paper.statements import STATEMENTS
from rubatlas.atlas_file import AtlasError

TINY = pathlib.Path(os.environ["RUBATLAS_PROGRAM"]).parent / "tests/tiny_atlas"
# Two settings, as `judge` writes them: name, setting, verdict, findings (holds, claim, brief).
VERDICTS = [
    ("P12", "", "not covered", [(None, "", "")]),
    ("P3", "kr = 30000 N/m", "agrees", [(True, "periodic", "0.5-0.6")]),
    ("P4", "kr = 30000 N/m", "partly", [(True, "there", ""), (False, "doubles", "0.61"), (True, "follows", "")]),
    ("P3", "kr = 1000 N/m", "disagrees", [(False, "periodic", "")]),
    ("P4", "kr = 1000 N/m", "disagrees", [(False, "there", ""), (False, "doubles", "")]),
]


class FolderTest(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    @staticmethod
    def run_command(name, *arguments):
        return subprocess.run([ROOT / "analysis/paper" / name, *map(str, arguments)], capture_output=True, text=True,
                              check=False)


class Judge(FolderTest):
    def judge(self, *arguments):
        ended = self.run_command("judge", *arguments)
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        return ended.stdout

    def test_a_real_atlas_has_a_verdict_and_its_numbers_on_every_statement(self):
        text = self.judge(TINY / "atlas.h5", TINY / "maps.h5")
        for name, statement in STATEMENTS.items():
            self.assertIn(f"\n{name:<6} {statement.claim[:40]}", "\n" + text)
        self.assertRegex(text, r"P1a .*\n +(agrees|partly|disagrees)\n +[+-] region 1: \(0\.2")
        self.assertIn("? this is not the paper's test rig", text)

    def test_the_width_of_a_region_is_known_to_the_end_of_the_grid_and_not_to_a_gap(self):
        with AtlasLines(TINY / "atlas.h5", TINY / "maps.h5") as atlas:
            line = atlas.lines[1]
        first, third = line.regions[0], line.regions[2]
        self.assertEqual((first.start, first.open_ends), (line.speed[0], 1))
        self.assertAlmostEqual(first.width, first.end - first.start)
        self.assertTrue(third.end < line.speed[-1] and third.open_ends == 2, "where the motion leaves the model")
        self.assertTrue(np.isnan(third.width))
        self.assertRegex(region_text(1, first), r"^region 1: \(0\.200\)-0\.\d{3}, ")
        self.assertRegex(region_text(3, third), r"^region 3: 0\.\d{3}-\(0\.\d{3}\), ")

    def test_maps_beside_an_atlas_are_found_and_several_atlases_share_a_table(self):
        text = self.judge(TINY / "atlas.h5", TINY / "maps.h5", TINY / "rings.h5", "--short")
        rows = [line for line in text.splitlines() if line.startswith("| P")]
        self.assertEqual(len(rows), len(STATEMENTS))
        self.assertTrue(any("atlas " in row and "rings " in row for row in rows), text)

    def test_the_files_that_it_keeps_say_what_it_prints_and_are_replaced(self):
        kept = ["--json", self.folder / "a.json", "--table", self.folder / "a.md"]
        for _ in range(2):
            self.judge(TINY / "atlas.h5", TINY / "maps.h5", *kept)
        [result] = json.loads((self.folder / "a.json").read_text())["rubatlas_statements"]
        self.assertEqual([one["name"] for one in result["verdicts"]], list(STATEMENTS))
        self.assertEqual((result["atlas"], result["law"]), ("atlas", "elastica"))
        table = (self.folder / "a.md").read_text()
        for one in result["verdicts"]:
            self.assertIn(f"| {one['name']} | {one['claim']} | {one['setting']} | {one['verdict']} | ", table)

    def test_what_it_cannot_judge_is_refused_in_one_sentence(self):
        (self.folder / "mine.json").write_text("{}")
        for arguments, says in (
                ([TINY / "basins.h5"], "one initial state, which is an axis here"),
                ([TINY / "gravity.h5"], "no maps beside it; `rubatlas analyse` makes them"),
                ([TINY / "maps.h5"], "these are maps; they stand behind their atlas"),
                ([TINY / "atlas.h5", TINY / "rings_maps.h5"], "was not made from the scene of"),
                ([TINY / "atlas.h5", TINY / "maps.h5", "--json", self.folder / "mine.json"], "this file is there")):
            ended = self.run_command("judge", *arguments)
            self.assertEqual((ended.returncode, ended.stdout), (2, ""), arguments)
            self.assertRegex(ended.stderr, r"\Ajudge: [^\n]*\n\Z")
            self.assertIn(says, ended.stderr)

    def test_an_atlas_that_is_not_there_has_the_exit_code_that_the_program_gives_it(self):
        program = subprocess.run([os.environ["RUBATLAS_PROGRAM"], "status", self.folder / "none.h5"],
                                 capture_output=True, check=False)
        tools = [self.run_command("judge", self.folder / "none.h5"),
                 subprocess.run([ROOT / "tools/rubatlas-plot", "map", self.folder / "none.h5", "-o",
                                 self.folder / "map.png"], capture_output=True, text=True, check=False)]
        for ended in tools:
            self.assertEqual((ended.returncode, ended.stdout), (program.returncode, ""))
            self.assertRegex(ended.stderr, r"\A[^\n]*none.h5: no such file\n\Z")
        self.assertEqual(program.returncode, 3)


class StatementMap(FolderTest):
    def written(self, verdicts=None):
        path = self.folder / "judged.json"
        kept = [{"name": name, "setting": setting, "verdict": verdict, "claim": "",
                 "findings": [{"holds": holds, "claim": claim, "brief": brief, "evidence": ""}
                              for holds, claim, brief in findings]}
                for name, setting, verdict, findings in verdicts or VERDICTS]
        path.write_text(json.dumps({"rubatlas_statements": [{"atlas": "a", "law": "elastic_ring", "verdicts": kept}]}))
        return path

    def test_a_column_is_a_setting_and_a_row_a_finding_of_any_column(self):
        columns = statement_map.columns_of(self.written(), ["P3", "P4"])
        self.assertEqual([column.setting for column in columns], ["kr = 30000 N/m", "kr = 1000 N/m"])
        self.assertEqual(statement_map.rows_of(columns, ["P3", "P4"]),
                         [("P3", "periodic"), ("P4", "there"), ("P4", "doubles"), ("P4", "follows")])
        # A row that the first column has not takes its place among those of its statement.
        self.assertEqual(statement_map.rows_of(columns[::-1], ["P3", "P4"]),
                         [("P3", "periodic"), ("P4", "there"), ("P4", "doubles"), ("P4", "follows")])

    def test_what_is_not_there_to_be_judged_does_not_count_as_found(self):
        columns = statement_map.columns_of(self.written(), ["P3", "P4"])
        rows = statement_map.rows_of(columns, ["P3", "P4"])
        self.assertEqual([statement_map.found(column, rows) for column in columns], [3, 0])
        self.assertIn("| elastic ring | kr = 30000 N/m | agrees 1/1 | partly 2/3 | 3/4 |",
                      statement_map.counts(columns, rows, ["P3", "P4"]))

    def test_columns_stand_in_the_order_of_their_numbers_upward_sweeps_first(self):
        def column(setting):
            return statement_map.Column("elastica", setting)
        settings = ["kr = 300 N/m", "kr = 1000 N/m", "kr = 3e+06 N/m", "direction = up, γ = 0.5",
                    "direction = down, γ = 0"]
        ordered = sorted(map(column, settings[::-1]), key=statement_map.place)
        self.assertEqual([one.setting for one in ordered if "kr" in one.setting], settings[:3])
        self.assertEqual(ordered[-1].setting, "direction = down, γ = 0")

    def test_what_two_atlases_say_of_one_setting_is_one_column(self):
        one, two = statement_map.Column("elastica", "γ = 0"), statement_map.Column("elastica", "γ = 0")
        one.findings, one.verdicts = {("P3", "periodic"): (1, ""), ("P8a", "four"): (0, "")}, {"P3": "agrees"}
        two.findings, two.verdicts = {("P3", "periodic"): (0, ""), ("P8a", "four"): (2, "")}, {"P3": "not covered"}
        other = statement_map.Column("elastic ring", "γ = 0")
        both, alone = statement_map.joined([one, two, other])
        self.assertEqual(both.findings, {("P3", "periodic"): (1, ""), ("P8a", "four"): (2, "")})
        self.assertEqual((both.verdicts, alone.law), ({"P3": "agrees"}, "elastic ring"))

    def test_what_judge_keeps_is_drawn(self):
        kept, picture = self.folder / "a.json", self.folder / "a.png"
        self.run_command("judge", TINY / "atlas.h5", TINY / "maps.h5", "--json", kept)
        columns = statement_map.columns_of(kept, ["P1a", "P5a", "P9a"])
        self.assertEqual([column.law for column in columns], ["elastica"])
        self.assertIn(("P1a", "trigger 1 at 1/3"), columns[0].findings)
        self.assertNotIn("P9a", columns[0].verdicts)
        ended = self.run_command("statement_map", kept, "-o", picture, "--counts")
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        self.assertTrue(picture.read_bytes().startswith(b"\x89PNG"))
        self.assertIn("| elastica | – | ", ended.stdout)

    def test_another_file_is_refused_in_one_sentence(self):
        with self.assertRaisesRegex(AtlasError, "judge --json"):
            statement_map.columns_of(TINY / "orbit.h5", ["P1a"])
        ended = self.run_command("statement_map", TINY / "atlas.h5", "-o", self.folder / "none.png")
        self.assertEqual(ended.returncode, 2)
        self.assertTrue(ended.stderr.startswith("statement_map: "), ended.stderr)


if __name__ == "__main__":
    unittest.main()

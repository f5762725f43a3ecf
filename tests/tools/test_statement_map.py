"""The map of statements: which rows and columns it has, and how it counts."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
TINY = pathlib.Path(os.environ["RUBATLAS_PROGRAM"]).parent / "tests/tiny_atlas"
sys.path.insert(0, str(ROOT / "tools"))
from rubatlas.plots import statement_map  # noqa: E402
from rubatlas.atlas_file import AtlasError  # noqa: E402

SCENE = '{"contact": {"law": "elastic_ring"}}'
# Two settings, as `rubatlas analyse` writes them: name, setting, verdict, findings (holds, claim, brief).
STATEMENTS = [
    ("P12", "", 0, [(0, "", "")]),
    ("P3", "kr = 30000 N/m", 1, [(1, "periodic", "0.5-0.6")]),
    ("P4", "kr = 30000 N/m", 2, [(1, "there", ""), (2, "doubles", "0.61"), (1, "follows", "")]),
    ("P3", "kr = 1000 N/m", 3, [(2, "periodic", "")]),
    ("P4", "kr = 1000 N/m", 3, [(2, "there", ""), (2, "doubles", "")]),
]


def write(path, statements=None):
    statements = STATEMENTS if statements is None else statements
    findings = [(index, *finding) for index, statement in enumerate(statements) for finding in statement[3]]
    with h5py.File(path, "w") as file:
        file["scene_resolved"] = SCENE
        file["statements/name"] = [one[0] for one in statements]
        file["statements/setting"] = [one[1] for one in statements]
        file["statements/verdict"] = np.array([one[2] for one in statements], dtype="u1")
        for column, name in enumerate(("statement", "holds", "claim", "brief")):
            file[f"findings/{name}"] = [one[column] for one in findings]


class StatementMap(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.temporary.name) / "maps.h5"

    def tearDown(self):
        self.temporary.cleanup()

    def test_a_column_is_a_setting_and_a_row_a_finding_of_any_column(self):
        write(self.path)
        columns = statement_map.columns_of(self.path, ["P3", "P4"])
        self.assertEqual([column.setting for column in columns], ["kr = 30000 N/m", "kr = 1000 N/m"])
        self.assertEqual(statement_map.rows_of(columns, ["P3", "P4"]),
                         [("P3", "periodic"), ("P4", "there"), ("P4", "doubles"), ("P4", "follows")])
        # A row that the first column has not takes its place among those of its statement.
        self.assertEqual(statement_map.rows_of(columns[::-1], ["P3", "P4"]),
                         [("P3", "periodic"), ("P4", "there"), ("P4", "doubles"), ("P4", "follows")])

    def test_what_is_not_there_to_be_judged_does_not_count_as_found(self):
        write(self.path)
        columns = statement_map.columns_of(self.path, ["P3", "P4"])
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

    def test_a_real_file_of_maps_has_the_statements_that_it_covers(self):
        columns = statement_map.columns_of(TINY / "maps.h5", ["P1", "P5", "P9"])
        self.assertEqual(len(columns), 1)
        self.assertEqual(columns[0].law, "elastica")
        self.assertIn(("P1", "trigger 1 at 1/3"), columns[0].findings)
        self.assertNotIn("P9", columns[0].verdicts)

    def test_another_file_is_refused_in_one_sentence(self):
        with self.assertRaisesRegex(AtlasError, "no /findings"):
            statement_map.columns_of(TINY / "orbit.h5", ["P1"])
        ended = subprocess.run([ROOT / "tools/rubatlas-plot", "statement_map", TINY / "atlas.h5", "-o", "none.png"],
                               capture_output=True, text=True, check=False)
        self.assertEqual(ended.returncode, 2)
        self.assertTrue(ended.stderr.startswith("rubatlas-plot statement_map: "), ended.stderr)


if __name__ == "__main__":
    unittest.main()

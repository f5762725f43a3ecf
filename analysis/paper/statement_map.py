"""The paper's statements against contact law, the ring's stiffness and other open quantities: what holds where.

  analysis/paper/statement_map FILE.json [FILE.json ...] -o PICTURE.png [--statements P1a,P1b,P2a] [--counts]

Each file is one that `analysis/paper/judge --json` writes; a column is one setting of what the grid of an atlas leaves
open (one stiffness of the ring, say), a row is one finding of a statement. The text in a cell is the number that the
finding rests on. Below each column: how many of the rows were found there. `--counts` prints the same as a Markdown
table, without a picture's worth of detail: the statements, and the sum.
"""
import argparse
import json
import pathlib
import re
import textwrap

import numpy as np

from rubatlas import command_line
from rubatlas import style
from rubatlas.atlas_file import AtlasError

from paper.verdict import JSON_KEY
from paper.verdict import NOT_COVERED as NO_VERDICT

NOT_COVERED, YES, NO = 0, 1, 2
HOLDS = {None: NOT_COVERED, True: YES, False: NO}
NOTHING = 3  # no finding
FIG_4 = "P1a,P1b,P2a,P2b,P3,P4,P5a,P5b,P5c,P6,P8a,P8b,P8c,P8d"
LOOKS = {YES: {"name": "found", "colour": "#86c2ad"}, NO: {"name": "not found", "colour": "#c0622a"},
         NOT_COVERED: {"name": "not covered by the atlas", "colour": "#ececf1", "hatch": "/"},
         NOTHING: {"name": "nothing to judge: its region is not there", "colour": "#ffffff"}}


class Column:
    """The findings of one atlas at one setting."""

    def __init__(self, law: str, setting: str) -> None:
        self.law, self.setting = law, setting
        self.findings: dict[tuple[str, str], tuple[int, str]] = {}  # (statement, claim) → (holds, brief)
        self.verdicts: dict[str, str] = {}  # by statement


def columns_of(path: str | pathlib.Path, statements: list[str]) -> list[Column]:
    """The columns of one file, in the order of its settings; AtlasError where it has no statements."""
    try:
        results = json.loads(pathlib.Path(path).read_text())[JSON_KEY]
    except (OSError, ValueError, KeyError, TypeError):
        raise AtlasError(f"{path}: not a file that `analysis/paper/judge --json` has written") from None
    columns: list[Column] = []
    for result in results:
        own: dict[str, Column] = {}
        for one in result["verdicts"]:
            if one["name"] in statements and (one["setting"] or one["verdict"] != NO_VERDICT):
                column = own.setdefault(one["setting"], Column(result["law"].replace("_", " "), one["setting"]))
                column.verdicts[one["name"]] = one["verdict"]
                column.findings |= {(one["name"], finding["claim"]): (HOLDS[finding["holds"]], finding["brief"])
                                    for finding in one["findings"] if finding["claim"]}
        columns += own.values()
    return columns


def joined(columns: list[Column]) -> list[Column]:
    """Columns of one law and setting, from several atlases, as one: of two findings that are covered the later."""
    result: dict[tuple[str, str], Column] = {}
    for column in columns:
        own = result.setdefault((column.law, column.setting), Column(column.law, column.setting))
        own.verdicts |= {name: verdict for name, verdict in column.verdicts.items()
                         if verdict != NO_VERDICT or name not in own.verdicts}
        own.findings |= {key: found for key, found in column.findings.items()
                         if found[0] != NOT_COVERED or key not in own.findings}
    return list(result.values())


def rows_of(columns: list[Column], statements: list[str]) -> list[tuple[str, str]]:
    """All findings of the columns, statement by statement, in the order in which they are judged."""
    rows: list[tuple[str, str]] = []
    for statement in statements:
        for column in columns:
            last = len(rows)
            for key in column.findings:
                if key[0] != statement:
                    continue
                if key in rows:
                    last = rows.index(key) + 1
                else:
                    rows.insert(last if any(row[0] == statement for row in rows) else len(rows), key)
                    last = rows.index(key) + 1
    return rows


def place(column: Column) -> tuple[bool, list[float]]:
    """The place of a column among those of its law: upward sweeps first, then by the numbers of its setting."""
    numbers = [float(value) for value in re.findall(r"= (-?[0-9.]+(?:e[-+]?[0-9]+)?)", column.setting)]
    return "down" in column.setting, numbers


def found(column: Column, rows: list[tuple[str, str]]) -> int:
    return sum(column.findings.get(row, (None, ""))[0] == YES for row in rows)


def counts(columns: list[Column], rows: list[tuple[str, str]], statements: list[str]) -> str:
    """The map in short, as Markdown."""
    lines = ["| law | at | " + " | ".join(statements) + " | found |", "|" + "---|" * (len(statements) + 3)]
    for column in columns:
        cells = []
        for statement in statements:
            own = [row for row in rows if row[0] == statement]
            verdict = column.verdicts.get(statement, NO_VERDICT).replace(NO_VERDICT, "–")
            cells.append(f"{verdict} {found(column, own)}/{len(own)}")
        row = [column.law, column.setting or "–", *cells, f"{found(column, rows)}/{len(rows)}"]
        lines.append(f"| {' | '.join(row)} |")
    return "\n".join(lines)


def heading(column: Column, between: str = "\n") -> str:
    return between.join([column.law, *filter(None, column.setting.replace("direction = ", "").split(", "))])


def draw(options: argparse.Namespace) -> None:
    statements = options.statements.split(",")
    columns = joined([column for path in options.judged for column in columns_of(path, statements)])
    laws = list(dict.fromkeys(column.law for column in columns))
    columns.sort(key=lambda column: (laws.index(column.law), place(column)))
    rows = rows_of(columns, statements)
    if not rows:
        raise AtlasError(f"{', '.join(options.judged)}: no finding of {options.statements}")
    if options.counts:
        print(counts(columns, rows, statements))
    height, width = 0.27 * len(rows), max(0.92 * len(columns), 3.5)
    narrow = style.is_narrow(options)
    figure = style.figure(options, (width + 3.4, height + 2.2))
    if narrow:
        # A claim takes up to two lines; cells have room for their colours alone.
        figure.set_figheight(0.25 * len(rows) + 2.2)
    axes = figure.add_subplot()
    kinds = np.empty((len(rows), len(columns)), dtype=int)
    for i, row in enumerate(rows):
        for j, column in enumerate(columns):
            kinds[i, j], brief = column.findings.get(row, (NOTHING, "·"))
            if not narrow:
                axes.text(j, i, brief, ha="center", va="center", fontsize=7, color=style.INK)
    borders = [np.arange(count + 1) - 0.5 for count in (len(columns), len(rows))]
    handles = style.cells_into(axes, [(entry, kinds == kind) for kind, entry in LOOKS.items()], borders)
    axes.invert_yaxis()
    axes.set_yticks(range(len(rows)), [textwrap.fill(f"{name}  {claim}", 26 if narrow else 99) for name, claim in rows])
    counted = [f"{found(column, rows)} of {len(rows)}" for column in columns]
    axes.set_xticks(range(len(columns)),
                    [f"{heading(column, ', ')}: {count}" if narrow else f"{heading(column)}\n\n{count}"
                     for column, count in zip(columns, counted)], rotation=90 if narrow else 0, fontsize=7)
    axes.set_xticks(np.arange(len(columns) - 1) + 0.5, minor=True)
    axes.set_yticks(np.arange(len(rows) - 1) + 0.5, minor=True)
    axes.grid(False)
    axes.grid(True, which="minor", color="white", lw=1.2)
    axes.tick_params(which="both", length=0)
    axes.set_axisbelow(False)
    for i in range(1, len(rows)):
        if rows[i][0] != rows[i - 1][0]:
            axes.axhline(i - 0.5, color=style.INK, lw=0.9)
    for j in range(1, len(columns)):
        if columns[j].law != columns[j - 1].law:
            axes.axvline(j - 0.5, color=style.INK, lw=0.9)
    axes.legend(handles=handles, loc="lower right", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.4,
                ncols=style.columns_of(axes, handles)[0])
    style.headline(figure, options.title)
    style.save(figure, options)


def main() -> None:
    command_line.end_with_the_reader()
    arguments = command_line.parser(__doc__, source="FILE.json", line=False)
    arguments.add_argument("more", nargs="*", metavar="FILE.json")
    arguments.add_argument("--statements", default=FIG_4, help="which, separated by commas")
    arguments.add_argument("--counts", action="store_true", help="print the counts as a Markdown table too")
    arguments.add_argument("--title", default="What the paper says of Fig. 4, by contact law")
    chosen = arguments.parse_args()
    chosen.judged = [chosen.source, *chosen.more]
    command_line.run(draw, chosen)

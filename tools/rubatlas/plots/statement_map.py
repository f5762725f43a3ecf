"""The paper's statements against contact law, the ring's stiffness and other open quantities: what holds where.

  rubatlas-plot statement_map MAPS.h5 [MAPS.h5 ...] -o PICTURE.png [--statements P1,P2,P3,P4,P5,P8] [--counts]

Each file is one that `rubatlas analyse` writes; a column is one setting of what its grid leaves open (one stiffness of
the ring, say), a row is one finding of a statement. The text in a cell is the number that the finding rests on. Below
each column: how many of the rows were found there. `--counts` prints the same as a Markdown table, without a picture's
worth of detail: the statements, and the sum.
"""
import json
import re
import textwrap

import numpy as np

from rubatlas import command_line
from rubatlas import style
from rubatlas.atlas_file import AtlasError, reading, text

NOT_COVERED, YES, NO = 0, 1, 2
NOTHING = 3  # no finding
LOOKS = {YES: {"name": "found", "colour": "#86c2ad"}, NO: {"name": "not found", "colour": "#c0622a"},
         NOT_COVERED: {"name": "not covered by the atlas", "colour": "#ececf1", "hatch": "/"},
         NOTHING: {"name": "nothing to judge: its region is not there", "colour": "#ffffff"}}
VERDICTS = {0: "–", 1: "agrees", 2: "partly", 3: "disagrees"}
LAWS = {"elastica": "elastica", "elastic_ring": "elastic ring"}


class Column:
    """The findings of one atlas at one setting."""

    def __init__(self, law, setting):
        self.law, self.setting = law, setting
        self.findings = {}  # (statement, claim) → (holds, brief)
        self.verdicts = {}  # statement → verdict


def columns_of(path, statements):
    """The columns of one file, in the order of its settings; AtlasError where it has no statements."""
    with reading(path, "a readable HDF5 file of rubatlas") as file:
        if "findings" not in file:
            raise AtlasError(f"{path}: no /findings; `rubatlas analyse` writes them for the paper's rotors only")
        scene = json.loads(text(file["scene_resolved"][()]))
        law = LAWS[scene["contact"]["law"]]
        read = {name: [text(value) for value in file[name][()]] for name in
                ("statements/name", "statements/setting", "findings/claim", "findings/brief")}
        verdict, holds, owner = (file[name][()]
                                 for name in ("statements/verdict", "findings/holds", "findings/statement"))
    columns: dict[str, Column] = {}
    for index, (name, setting) in enumerate(zip(read["statements/name"], read["statements/setting"])):
        if name in statements and (setting or verdict[index]):
            own = columns.setdefault(setting, Column(law, setting))
            own.verdicts[name] = int(verdict[index])
    for holding, index, claim, brief in zip(holds, owner, read["findings/claim"], read["findings/brief"]):
        name, setting = read["statements/name"][index], read["statements/setting"][index]
        if name in statements and setting in columns and claim:
            columns[setting].findings[name, claim] = (int(holding), brief)
    return list(columns.values())


def rows_of(columns, statements):
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


def place(column):
    """The place of a column among those of its law: upward sweeps first, then by the numbers of its setting."""
    numbers = [float(value) for value in re.findall(r"= (-?[0-9.]+(?:e[-+]?[0-9]+)?)", column.setting)]
    return "down" in column.setting, numbers


def found(column, rows):
    return sum(column.findings.get(row, (None, ""))[0] == YES for row in rows)


def counts(columns, rows, statements):
    """The map in short, as Markdown."""
    lines = ["| law | at | " + " | ".join(statements) + " | found |", "|" + "---|" * (len(statements) + 3)]
    for column in columns:
        cells = []
        for statement in statements:
            own = [row for row in rows if row[0] == statement]
            cells.append(f"{VERDICTS[column.verdicts.get(statement, 0)]} {found(column, own)}/{len(own)}")
        row = [column.law, column.setting, *cells, f"{found(column, rows)}/{len(rows)}"]
        lines.append(f"| {' | '.join(row)} |")
    return "\n".join(lines)


def heading(column, between="\n"):
    return between.join([column.law, *filter(None, column.setting.replace("direction = ", "").split(", "))])


def draw(options):
    statements = options.statements.split(",")
    columns = [column for path in options.maps for column in columns_of(path, statements)]
    laws = list(dict.fromkeys(column.law for column in columns))
    columns.sort(key=lambda column: (laws.index(column.law), place(column)))
    rows = rows_of(columns, statements)
    if not rows:
        raise AtlasError(f"{', '.join(options.maps)}: no finding of {options.statements}")
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
    image = {"aspect": "auto", "interpolation": "nearest", "extent": (-0.5, len(columns) - 0.5, -0.5, len(rows) - 0.5),
             "origin": "lower"}
    handles = style.cells_into(axes, [(entry, kinds == kind) for kind, entry in LOOKS.items()], image)
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


def main(arguments_given):
    arguments = command_line.parser(__doc__, source="MAPS.h5", line=False)
    arguments.add_argument("more", nargs="*", metavar="MAPS.h5")
    arguments.add_argument("--statements", default="P1,P2,P3,P4,P5,P6,P8", help="which, separated by commas")
    arguments.add_argument("--counts", action="store_true", help="print the counts as a Markdown table too")
    arguments.add_argument("--title", default="What the paper says of Fig. 4, by contact law")
    chosen = arguments.parse_args(arguments_given)
    chosen.maps = [chosen.source, *chosen.more]
    command_line.run(draw, chosen)

"""The statements of the paper on atlases of its rotors.

  analysis/paper/judge ATLAS.h5 [MAPS.h5] [ATLAS.h5 ...] [--short] [--json FILE.json] [--table FILE.md]

Prints a table: letter, sentence, verdict, and the numbers that it rests on (+ found, - not found, ? not covered). The
maps of an atlas (`rubatlas analyse`) are ATLAS_maps.h5 beside it, or stand behind it in the call. Of several atlases a
statement shows those that cover it; --short has one line for each statement. --json keeps everything, of which
`analysis/paper/statement_map` draws a map.
"""
import itertools
import json
import pathlib
import textwrap
from collections.abc import Sequence
from typing import Any

import h5py
from rubatlas import command_line
from rubatlas.atlas_file import UNREADABLE, AtlasError

from paper.atlas_lines import AtlasLines
from paper.judgement import Verdict, best_known, judge
from paper.statements import STATEMENTS
from paper.verdict import AGREES, DISAGREES, JSON_KEY, NOT_COVERED, PARTLY

MARK = {True: "+", False: "-", None: "?"}
COLUMNS = 100
MOST_SETTINGS = 3  # of an atlas in a line of the short table; of more it says how many
TABLE_MARK = "<!-- the paper's statements, judged -->"  # by which a table of this command is known
Row = dict[str, list[tuple[str, Verdict]]]


def _is_maps(path: str) -> bool:
    try:
        with h5py.File(path, "r") as file:
            return "class" in file and "status" not in file
    except UNREADABLE:
        return False


def _pairs(files: Sequence[str]) -> list[tuple[str, str | None]]:
    """Atlases with the maps that stand behind them."""
    pairs: list[tuple[str, str | None]] = []
    for path in files:
        if not _is_maps(path):
            pairs.append((path, None))
        elif not pairs or pairs[-1][1] is not None:
            raise AtlasError(f"{path}: these are maps; they stand behind their atlas")
        else:
            pairs[-1] = (pairs[-1][0], path)
    return pairs


def judged(files: Sequence[str]) -> list[dict[str, Any]]:
    """What --json keeps: the verdicts of each atlas."""
    result = []
    for path, maps in _pairs(files):
        with AtlasLines(path, maps) as atlas:
            result.append({"atlas": pathlib.Path(path).stem, "title": atlas.scene.get("title", ""),
                           "law": atlas.scene["contact"]["law"], "verdicts": judge(atlas)})
    return result


def _rows(results: Sequence[dict[str, Any]]) -> Row:
    return best_known({one["atlas"]: one["verdicts"] for one in results})


def _place(atlas: str, one: Verdict, several: bool) -> str:
    return ", ".join(filter(None, [atlas if several else "", one.setting]))


def plain(rows: Row, several: bool) -> str:
    """The table as text."""
    lines = []
    for name, verdicts in rows.items():
        lines.append(textwrap.fill(f"{name:<6} {STATEMENTS[name].claim}", COLUMNS, subsequent_indent=7 * " "))
        for atlas, one in verdicts:
            place = _place(atlas, one, several and one.verdict != NOT_COVERED)
            lines.append(f"       {one.verdict}{f', {place}' if place else ''}")
            lines += [textwrap.fill(f"{MARK[finding.holds]} {finding.evidence}", COLUMNS, initial_indent=9 * " ",
                                    subsequent_indent=11 * " ") for finding in one.findings]
    return "\n".join(lines)


def short(rows: Row, several: bool) -> str:
    """One line of Markdown for each statement: where it agrees, holds partly, disagrees."""
    lines = ["| | what the paper says | verdict | where |", "|---|---|---|---|"]
    for name, verdicts in rows.items():
        there: dict[str, list[str]] = {word: [] for word in (AGREES, PARTLY, DISAGREES)}
        for atlas, own in itertools.groupby(verdicts, key=lambda one: one[0]):
            settings = [one for _, one in own]
            for word, places in there.items():
                here = [one for one in settings if one.verdict == word]
                if len(settings) > MOST_SETTINGS and here:
                    places.append(f"{atlas} at {len(here)} of {len(settings)} settings")
                    continue
                for one in here:
                    found = [finding.holds for finding in one.findings if finding.holds is not None]
                    places.append(f"{_place(atlas, one, several)} {sum(found)}/{len(found)}".strip())
        words = [word for word, places in there.items() if places]
        where = "; ".join(f"{word}: {', '.join(there[word])}" if len(words) > 1 else ", ".join(there[word])
                          for word in words) or verdicts[0][1].findings[0].evidence
        lines.append(f"| {name} | {STATEMENTS[name].claim} | {' / '.join(words) or NOT_COVERED} | {where} |")
    return "\n".join(lines)


def markdown(rows: Row, several: bool) -> str:
    lines = [TABLE_MARK, "| | what the paper says | at | verdict | evidence |", "|---|---|---|---|---|"]
    for name, verdicts in rows.items():
        for atlas, one in verdicts:
            evidence = "<br>".join(f"{MARK[finding.holds]} {finding.evidence}" for finding in one.findings)
            lines.append(f"| {name} | {STATEMENTS[name].claim} | {_place(atlas, one, several)} | {one.verdict} | "
                         f"{evidence} |")
    return "\n".join(lines) + "\n"


def _require_own(path: pathlib.Path, start: str) -> None:
    """A file that is there is replaced where this command has written it."""
    if path.exists() and (not path.is_file() or not path.read_bytes().startswith(start.encode())):
        raise AtlasError(f"{path}: this file is there and is not one that this command writes")
    if not path.parent.is_dir():
        raise AtlasError(f"{path}: there is no folder {path.parent}")


def main() -> None:
    command_line.end_with_the_reader()
    arguments = command_line.Arguments(__doc__ or "")
    arguments.add_argument("files", nargs="+", metavar="ATLAS.h5", help="atlases, each with its maps behind it")
    arguments.add_argument("--short", action="store_true", help="one line for each statement, as Markdown")
    arguments.add_argument("--json", type=pathlib.Path, metavar="FILE.json", help="keeps all verdicts and findings")
    arguments.add_argument("--table", type=pathlib.Path, metavar="FILE.md", help="keeps the whole table as Markdown")
    chosen = arguments.parse_args()

    def work() -> None:
        start = f'{{\n "{JSON_KEY}":'
        for path, begin in ((chosen.json, start), (chosen.table, TABLE_MARK)):
            if path is not None:
                _require_own(path, begin)
        results = judged(chosen.files)
        rows, several = _rows(results), len(results) > 1
        if chosen.json is not None:
            kept = [{**one, "verdicts": [verdict.as_json() for verdict in one["verdicts"]]} for one in results]
            text = json.dumps({JSON_KEY: kept}, indent=1, ensure_ascii=False) + "\n"
            command_line.write_complete(chosen.json, text.encode())
        if chosen.table is not None:
            command_line.write_complete(chosen.table, markdown(rows, several).encode())
        print((short if chosen.short else plain)(rows, several))
    command_line.end_on_mistakes(work)

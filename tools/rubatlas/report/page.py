"""Puts a report together: the page's sources, the plotting library and the data in one HTML file.

Nothing of the data is ever part of the markup. JSON and blocks stand in script elements of types that no browser runs,
with `<` escaped, so that no text of a scene can end its element; the page shows texts as text.
"""
import json
import pathlib

from rubatlas.palette import PALETTE
from rubatlas.query import GRAMMAR

FOLDER = pathlib.Path(__file__).resolve().parent
GENERATOR = '<meta name="generator" content="rubatlas-report">'

# In the order in which they build on each other.
SCRIPTS = ("data", "query", "chart", "export", "map", "elastica", "rotor", "point", "tables", "main")


def source(*parts):
    return FOLDER.joinpath(*parts).read_text(encoding="utf-8")


def inert(value):
    """JSON that may stand in a script element."""
    return json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c") \
        .replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def page(contents, blocks):
    scripts = "\n".join(source("page", f"{name}.js") for name in SCRIPTS)
    worker = source("page", "solver.js") + source("page", "worker.js")
    parts = {
        "GENERATOR": GENERATOR,
        "STYLES": source("vendor", "uplot", "uPlot.min.css") + source("page", "style.css"),
        "LICENCE": source("vendor", "uplot", "LICENSE").strip(),
        "LIBRARY": source("vendor", "uplot", "uPlot.iife.min.js"),
        "SCRIPTS": f"(() => {{\n'use strict';\n{scripts}\n}})();",
        "WORKER": inert(worker),
        "GRAMMAR": inert(GRAMMAR),
        "PALETTE": inert(PALETTE),
        "ATLAS": inert(contents),
        "BLOCKS": "\n".join(f'<script type="application/octet-stream" data-block="{name}">{content}</script>'
                            for name, content in blocks.texts.items()),
    }
    # Part by part, so that a mark that occurs in the data stays what it is.
    result, rest = [], source("page", "page.html")
    while "%%" in rest:
        before, name, rest = rest.split("%%", 2)
        result += [before, parts[name]]
    return "".join([*result, rest])

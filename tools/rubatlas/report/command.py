"""Makes one HTML file of an atlas: maps, points with sections and spectra, and the solver to compute further points.

  tools/rubatlas-report ATLAS.h5 [-o REPORT.html] [--maps MAPS.h5] [--solver RUBATLAS.wasm | --without-solver]
                        [--orbits COUNT]

The file needs no server and no network: a double click opens it. Maps (`rubatlas analyse`) are taken from ATLAS_maps.h5
beside the atlas where --maps does not name them, the solver from build/rubatlas.wasm of the clone. Where the page
cannot compute a scene, the program computes orbits of some of its points.
"""
import argparse
import contextlib
import os
import pathlib

from rubatlas import command_line
from rubatlas.atlas_file import AtlasError, AtlasFile, beside, counted

from rubatlas.report.contents import ORBITS, contents
from rubatlas.report.page import GENERATOR, page

CLONE = pathlib.Path(__file__).resolve().parents[3]


def is_report(path):
    with open(path, "rb") as file:
        return GENERATOR.encode() in file.read(2048)


def require_report_place(path, inputs):
    """A report may be written to `path`: its folder is there, and what it replaces is a report."""
    path = pathlib.Path(path)
    if path.suffix.lower() not in (".html", ".htm"):
        raise AtlasError(f"-o {path}: a report ends in .html, not in {repr(path.suffix) if path.suffix else 'nothing'}")
    if not path.parent.is_dir():
        raise AtlasError(f"-o {path}: there is no folder {path.parent}")
    if not path.exists():
        return
    for source in inputs:
        if os.path.exists(source) and os.path.samefile(path, source):
            raise AtlasError(f"-o {path}: the report would replace {source}, which it is made from")
    if not path.is_file():
        raise AtlasError(f"-o {path}: this is no file that a report could replace")
    if not is_report(path):
        raise AtlasError(f"-o {path}: this file is there and is no report; a report replaces reports only")


def maps_of(options):
    """Path of the maps: as named, else beside the atlas where they are there."""
    return options.maps if options.maps is not None else beside(options.source, "maps")


def solver_of(options):
    """Bytes of the solver: of the file that is named, else of the clone's build, else none."""
    if options.without_solver:
        return None
    path = pathlib.Path(options.solver) if options.solver else CLONE / "build" / "rubatlas.wasm"
    if not path.is_file():
        if options.solver:
            raise AtlasError(f"--solver {path}: no such file; `cmake --build build --target rubatlas_wasm` makes "
                             "build/rubatlas.wasm")
        return None
    content = path.read_bytes()
    if not content.startswith(b"\0asm"):
        raise AtlasError(f"{path}: not a WebAssembly module")
    return content


def make(options):
    maps_path = maps_of(options)
    require_report_place(options.output, [options.source, *([maps_path] if maps_path else [])])
    solver = solver_of(options)
    with contextlib.ExitStack() as stack:
        atlas = stack.enter_context(AtlasFile(options.source))
        if "status" not in atlas:
            raise AtlasError(f"{options.source}: no /status; a report is made of an atlas, and its maps are named with "
                             "--maps")
        maps = stack.enter_context(AtlasFile(maps_path)) if maps_path else None
        result, blocks = contents(atlas, maps, solver, options.orbits)
    content = page(result, blocks)
    command_line.write_complete(pathlib.Path(options.output), content.encode("utf-8"))
    said = f"{options.output}: {len(content.encode()) / 1e6:.1f} MB, "
    kept = result["lines"]["poincare"]
    said += f"{kept['sections']} of {counted(kept['of'], 'sections')} a point" if kept else "without sections"
    if result["orbits"] or result["not_computed"]:
        said += f", {counted(len(result['orbits']), 'orbits')}"
    if result["not_computed"]:
        said += f". {result['not_computed']}"
    if result["no_orbits"]:
        said += f" No orbits: {result['no_orbits']}."
    print(said)


def orbit_count(word):
    if not word.isdecimal():
        raise argparse.ArgumentTypeError(f"{word} is no whole number")
    return int(word)


def main():
    """The command `rubatlas-report`."""
    command_line.end_with_the_reader()
    parser = command_line.Arguments(__doc__, prog="rubatlas-report")
    parser.add_argument("source", metavar="ATLAS.h5")
    parser.add_argument("-o", "--output", metavar="REPORT.html", help="default: ATLAS.html in the present folder")
    parser.add_argument("--maps", metavar="MAPS.h5",
                        help="maps of this atlas; default: ATLAS_maps.h5 beside it, if it is there")
    solver = parser.add_mutually_exclusive_group()
    solver.add_argument("--solver", metavar="RUBATLAS.wasm",
                        help="default: build/rubatlas.wasm of the clone, if it is there")
    solver.add_argument("--without-solver", action="store_true", help="the page computes nothing")
    parser.add_argument("--orbits", metavar="COUNT", type=orbit_count,
                        help=f"orbits that the program computes now, of points spread over the atlas; default: "
                             f"{ORBITS} where the page cannot compute them, else 0")
    options = parser.parse_args()
    if options.output is None:
        options.output = pathlib.Path(options.source).stem + ".html"
    command_line.end_on_mistakes(lambda: make(options))

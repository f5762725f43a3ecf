"""All pictures that an atlas and its maps have to show, each as its own kind draws it by default.

  rubatlas-plot all ATLAS.h5 -o FOLDER [--maps MAPS.h5]

Of each kind that draws an atlas there is a picture; one that cannot be drawn is left out with a sentence that says why.
With several swept parameters stack.png, displacement.png, sensitivity.png and margin.png are along the first of them,
and stack_AXIS.png and so on along each of the others. Of an atlas whose initial state is an axis there is one picture,
basins.png: a line has one of many initial states, and says little.
"""
import importlib
import pathlib
import sys

from rubatlas import command_line
from rubatlas.atlas_file import AtlasError


def pictures(atlas, maps):
    """Of each picture its name, its kind, and the options that are not the kind's own choice."""
    if maps and "basins" in maps:
        return [("basins", "basins", [])]
    found: list[tuple[str, str, list[str]]] = [(kind, kind, []) for kind in ("bifurcation", "waterfall", "signature")]
    for number, axis in enumerate(atlas.swept_axes() or [None]):
        along = ["--along", axis] if axis else []
        behind = f"_{axis}" if number else ""
        found += [(f"stack{behind}", "stack", along)] if axis else []
        found += [(f"displacement{behind}", "displacement", along), (f"sensitivity{behind}", "map", along),
                  *([(f"sensitivity_blade_passing{behind}", "map", [*along, "--passing"])] if maps else []),
                  (f"margin{behind}", "margin", along)]
    return [*found, ("blade", "blade", [])]


def is_drawn(kind, arguments):
    """Draws a picture; False where its kind has refused it, and said why."""
    try:
        importlib.import_module(f"rubatlas.plots.{kind}").main(arguments)
    except SystemExit as end:
        if end.code != 2:
            raise
        return False
    return True


def draw(options):
    with command_line.atlas_with_maps(options) as (atlas, maps):
        atlas.dataset("status")  # maps have none
        found = pictures(atlas, maps)
        with_maps = ["--maps", str(maps.path)] if maps else []
    if options.output.is_file():
        raise AtlasError(f"{options.output}: a file is there; the pictures go into a folder")
    options.output.mkdir(parents=True, exist_ok=True)
    size = [f"--{name}={value}{unit}" for name, value, unit in
            (("width", options.width, "in"), ("dpi", options.dpi, "")) if value is not None]
    command, drawn = sys.argv[0], 0
    for name, kind, chosen in found:
        if kind in ("map", "stack", "basins", "margin", "signature"):
            chosen = [*chosen, *with_maps]
        sys.argv[0] = f"{command}: {name} is left out"  # for messages
        drawn += is_drawn(kind, [str(options.source), "-o", str(options.output / f"{name}.png"), *size, *chosen])
    sys.argv[0] = command
    if not drawn:
        raise AtlasError(f"{options.source}: there is nothing to draw")


def main(arguments_given):
    arguments = command_line.Arguments(__doc__)
    arguments.add_argument("source", metavar="ATLAS.h5")
    arguments.add_argument("-o", "--output", required=True, type=pathlib.Path, metavar="FOLDER")
    command_line.add_size(arguments)
    command_line.add_maps(arguments, "which have classes, margins, signs and basins")
    chosen = arguments.parse_args(arguments_given)
    command_line.end_on_mistakes(lambda: draw(chosen))

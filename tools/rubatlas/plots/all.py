"""All pictures that an atlas and its maps have to show, each as its own kind draws it by default.

  rubatlas-plot all ATLAS.h5 -o FOLDER [--maps MAPS.h5]

With several swept parameters stack.png, displacement.png and sensitivity.png are along the first of them, and
stack_AXIS.png and so on along each of the others. Of an atlas whose initial state is an axis there
is one picture, basins.png: a line has one of many initial states, and says little.
"""
import importlib
import pathlib

from rubatlas import command_line
from rubatlas.atlas_file import AtlasFile
from rubatlas.plots.blade import CURVES
from rubatlas.same_scene import require_maps_of


def pictures(atlas, maps):
    """Of each picture its name, its kind, and the options that are not the kind's own choice."""
    if "basins" in maps:
        return [("basins", "basins", [])]
    found: list[tuple[str, str, list[str]]] = []
    if "poincare" in atlas:
        found.append(("bifurcation", "bifurcation", []))
        found += [(f"stack_{axis}" if number else "stack", "stack", ["--along", axis])
                  for number, axis in enumerate(atlas.swept_axes())]
    if "spectrum" in atlas:
        found.append(("waterfall", "waterfall", []))
    if "max_displacement" in atlas:
        for number, axis in enumerate(atlas.swept_axes() or [None]):
            along = ["--along", axis] if axis else []
            behind = f"_{axis}" if number else ""
            found += [(f"displacement{behind}", "displacement", along), (f"sensitivity{behind}", "map", along)]
            if "class_blade_passing" in maps:
                found.append((f"sensitivity_blade_passing{behind}", "map", [*along, "--passing"]))
    if atlas.scene["contact"]["law"] in CURVES:  # rigid blades have no curve of force over displacement
        found.append(("blade", "blade", []))
    return found


def draw(options):
    maps_path = command_line.maps_of(options, required=True)
    with AtlasFile(options.source) as atlas, AtlasFile(maps_path) as maps:
        require_maps_of(atlas, maps)
        found = pictures(atlas, maps)
    options.output.mkdir(parents=True, exist_ok=True)
    size = [f"--{name}={value}{unit}" for name, value, unit in
            (("width", options.width, "in"), ("dpi", options.dpi, "")) if value is not None]
    for name, kind, chosen in found:
        if kind in ("map", "stack", "basins"):
            chosen = [*chosen, "--maps", str(maps_path)]
        output = options.output / f"{name}.png"
        importlib.import_module(f"rubatlas.plots.{kind}").main([str(options.source), "-o", str(output), *size, *chosen])


def main(arguments_given):
    arguments = command_line.Arguments(__doc__)
    arguments.add_argument("source", metavar="ATLAS.h5")
    arguments.add_argument("-o", "--output", required=True, type=pathlib.Path, metavar="FOLDER")
    command_line.add_size(arguments)
    command_line.add_maps(arguments, "which have classes and basins")
    chosen = arguments.parse_args(arguments_given)
    command_line.end_on_mistakes(lambda: draw(chosen))

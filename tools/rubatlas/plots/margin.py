"""How far every point is from a change of motion, and from the predicted grazing, over the speed ratio and a parameter.

  rubatlas-plot margin ATLAS.h5 -o PICTURE.png [--maps MAPS.h5] [--along damping_ratio] [--friction 0.1 ...]

Above, the distance in speed ratio to the nearest border between two classes of motion; below, where the maps have it,
that to where the trend of the nearest miss reaches zero. Dark is near.
"""
import numpy as np

from rubatlas import command_line
from rubatlas import style
from rubatlas.atlas_file import DONE, AtlasError, AtlasFile
from rubatlas.plots.displacement import along_of
from rubatlas.plots.map import finish, rows_of, size_of
from rubatlas.same_scene import require_maps_of

NAMES = {"speed_ratio": "Distance in Ω to the nearest change of motion",
         "speed_ratio_to_grazing": "Distance in Ω to the predicted grazing"}


# What a point has that is done and has no margin.
NONE = "no change of motion on its line", "no grazing is predicted"


def dataset_of(name):
    """Of a margin, named by its axis, in the maps."""
    return f"margins/along_{name}"


def label(maps, name):
    """Of a margin's colour bar."""
    return "Margin in Ω [-]" if name in NAMES else f"Margin [{maps.units(dataset_of(name))}]"


def into(panel, atlas, maps, along, wanted, name="speed_ratio"):
    """A margin of the maps; returns the image, for a colour bar, and the legend of points without a margin."""
    require_maps_of(atlas, maps)
    if dataset_of(name) not in maps:
        raise AtlasError(f"{maps.path}: it has no /{dataset_of(name)}; `rubatlas analyse` writes margins where "
                         "motions have classes, along axes with several values")
    along, lines, place = rows_of(atlas, along, wanted)
    values = np.abs(np.array([np.where(line.chosen(), maps.file[dataset_of(name)][line.index], np.nan)
                              for line in lines]))
    # A border is known to half a step of the speed; what is nearer than a tenth of a step is rounding, and would use
    # up the colours.
    steps = np.diff(atlas.axis(name if name in atlas.axes else "speed_ratio"))
    least = 0.1 * np.abs(steps).min() if len(steps) else 1e-6
    most = max(np.nanmax(values, initial=least), 2.0 * least)
    image = style.image_into(panel, np.ma.masked_invalid(np.maximum(values, least)), place, cmap=style.SEQUENTIAL,
                             norm=style.matplotlib.colors.LogNorm(least, most))
    status = np.array([line.status() for line in lines])
    handles = style.cells_into(panel, style.missing_cells(status), place)
    if (np.isnan(values) & (status == DONE)).any():
        handles.append(style.Patch(facecolor="white", edgecolor=style.QUIET, lw=0.5, label=NONE[name != "speed_ratio"]))
    panel.set_title(NAMES.get(name, f"Distance to the nearest change of motion along {name.replace('_', ' ')}"))
    finish(panel, atlas, along, lines)
    return image, handles


def draw(options):
    with AtlasFile(options.source) as atlas, AtlasFile(command_line.maps_of(options, required=True)) as maps:
        wanted = command_line.wanted(options, atlas.axes)
        along, lines, _ = rows_of(atlas, along_of(atlas, options.along, wanted), wanted)
        names = [name for name in NAMES if dataset_of(name) in maps] or ["speed_ratio"]
        figure, panels = style.subplots(options, len(names), 1, size_of(options, len(names), lines))
        handles = {}  # of both panels, by their words
        for panel, name in zip(panels[:, 0], names):
            image, found = into(panel, atlas, maps, along, wanted, name)
            handles.update({handle.get_label(): handle for handle in found})
            style.colour_bar(image, label(maps, name), ax=panel, pad=0.01)
        style.legend(panels[-1, 0], options, list(handles.values()), "below")
        style.rpm_axis(panels[0, 0], atlas.sizes())
        style.title(figure, atlas, panels[0, 0].get_title(loc="left") + ": " + lines[0].describe(without=[along]))
        style.save(figure, options)


def main(arguments_given):
    arguments = command_line.parser(__doc__)
    command_line.add_maps(arguments, "which have the margins")
    arguments.add_argument("--along", metavar="AXIS", help="the parameter to draw over (default: the first swept one)")
    command_line.run(draw, arguments.parse_args(arguments_given))

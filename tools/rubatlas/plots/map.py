"""Sensitivity map: maximum displacement, and class of motion, over the speed ratio and one parameter.

  rubatlas-plot map ATLAS.h5 -o PICTURE.png [--maps MAPS.h5] [--curve CURVE.h5] [--along damping_ratio] [--passing]

The classes come from the file that `rubatlas analyse ATLAS.h5 -o MAPS.h5` writes; without it only the displacement is
drawn. Rows are as high as each other, whatever the distance of their values.
"""

import numpy as np

from rubatlas import command_line
from rubatlas import style
from rubatlas.atlas_file import DIRECTIONS, AtlasError
from rubatlas.plots.branch import BranchFile
from rubatlas.plots.displacement import along_of
from rubatlas.same_scene import require_maps_of


NO_CONTACT = 1  # as maps number it


def rows_of(atlas, along, wanted):
    """The lines along a parameter, and where their cells lie."""
    if along is None:
        along = atlas.axes[-2]
    if along not in atlas.axes[:-1]:
        raise AtlasError(f"{along} is no axis of {atlas.path}, which has {', '.join(atlas.axes[:-1])}")
    lines = atlas.lines(along, **wanted)
    return along, lines, place_of(atlas.axis("speed_ratio"), len(lines))


def place_of(speed, count):
    """Where the cells of so many lines lie, a row for each."""
    return style.edges_of(speed), np.arange(count + 1) - 0.5


def size_of(options, panels, lines):
    """Of a picture with panels of so many rows [inch]; in a column of a journal few rows still need room for words."""
    return 9.5, 1.3 + panels * max(2.6 if style.is_narrow(options) else 1.6, 0.32 * len(lines) + 0.6)


def value_of(line, along):
    """A line's value of a parameter, in the unit that it is drawn in."""
    value = line.value(along)
    return DIRECTIONS[int(value)] if along == "direction" else f"{style.drawn(line.atlas.units(along))[1] * value:g}"


def finish(panel, atlas, along, lines):
    """Ticks at the values of the parameter, which are drawn as far apart as each other."""
    count = len(lines)
    panel.grid(False)
    panel.set_yticks(range(count), [value_of(line, along) for line in lines])
    panel.set_yticks(np.arange(count - 1) + 0.5, minor=True)
    panel.grid(True, axis="y", which="minor", color="white", lw=1.2)
    panel.tick_params(which="minor", length=0)
    panel.set_axisbelow(False)
    panel.set_ylabel(style.label(atlas, along))
    panel.set_xlabel(style.label(atlas, "speed_ratio"))


def into(panel, atlas, along, wanted, name="max_displacement"):
    """A quantity with one value per point over the speed ratio and a parameter; returns the image, for a colour bar,
    and the legend of points without a motion."""
    along, lines, place = rows_of(atlas, along, wanted)
    factor = style.drawn(atlas.units(name))[1]
    values = factor * np.array([line.rows(name) for line in lines])
    if values.ndim != 2:
        raise AtlasError(f"{name}: more than one number per point; a map needs one")
    # Logarithmic, over three decades: the small motion below the first trigger has a structure of its own.
    largest = np.nanmax(values, initial=0.0) or 1.0
    image = style.image_into(panel, np.ma.masked_invalid(np.maximum(values, 1e-3 * largest)), place,
                             cmap=style.SEQUENTIAL, norm=style.matplotlib.colors.LogNorm(1e-3 * largest, largest))
    gaps = style.cells_into(panel, style.missing_cells(np.array([line.status() for line in lines])), place)
    finish(panel, atlas, along, lines)
    return image, gaps


def class_cells_of(maps, lines, name="class"):
    """The classes of motion of lines of an atlas, as `style.cells_into` draws them."""
    atlas = lines[0].atlas
    require_maps_of(atlas, maps)
    if name not in maps:
        raise AtlasError(f"{maps.path}: it has no /{name}; `rubatlas analyse` writes it for atlases with "
                         "poincare_blade_passing")
    classes = np.array([np.where(line.chosen(), maps.dataset(name)[line.index], 0) for line in lines])
    status = np.array([line.status() for line in lines])
    untouched = np.array([line.chosen() & (maps.dataset("contact")[line.index] == NO_CONTACT) for line in lines])
    return style.class_cells(classes, status, untouched)


def classes_into(panel, atlas, maps, along, wanted, passing=False):
    """The class of motion likewise; returns the entries of its legend."""
    along, lines, place = rows_of(atlas, along, wanted)
    cells = class_cells_of(maps, lines, "class_blade_passing" if passing else "class")
    handles = style.cells_into(panel, cells, place)
    panel.set_title("Class of motion, in blade passings" if passing else "Class of motion, in revolutions")
    finish(panel, atlas, along, lines)
    return handles


def curve_into(panels, atlas, along, curve):
    """A curve of bifurcations (`rubatlas branch --curve`) over a map: the border of a region."""
    if "second_parameter" not in curve:
        raise AtlasError(f"{curve.path}: a branch, not a curve in two quantities; `rubatlas branch --curve` makes one")
    quantity = curve.name_of("in").replace(" ", "_")
    if curve.name_of("along") != "speed ratio" or {"moment": "unbalance"}.get(quantity, quantity) != along:
        raise AtlasError(f"{curve.path}: a curve in {curve.name_of('along')} and {curve.name_of('in')}, "
                         f"not in speed ratio and {along}")
    values = atlas.axis(along)
    where = np.interp(curve["second_parameter"], values, np.arange(len(values)), left=np.nan, right=np.nan)
    for panel in panels:
        panel.plot(curve["parameter"], where, color=style.VERMILION, lw=1.8, scalex=False, scaley=False,
                   label=curve.attribute("curve").replace("_", " "))
    panels[0].legend(loc="lower right", frameon=True)


def draw(options):
    with command_line.atlas_with_maps(options) as (atlas, maps):
        wanted = command_line.wanted(options, atlas.axes)
        along, lines, _ = rows_of(atlas, along_of(atlas, options.along, wanted), wanted)
        count = 1 if maps is None else 2
        figure = style.figure(options, size_of(options, count, lines))
        narrow = style.is_narrow(options)
        grid = figure.add_gridspec(count, 2, width_ratios=[1, 0.04 if narrow else 0.02])
        panels = [figure.add_subplot(grid[row, 0]) for row in range(count)]
        sides = [figure.add_subplot(grid[row, 1]) for row in range(count)]
        image, handles = into(panels[0], atlas, along, wanted)
        style.colour_bar(image, f"Max. displacement [{style.drawn(atlas.units('max_displacement'))[0]}]", cax=sides[0])
        if maps is not None:
            handles = classes_into(panels[1], atlas, maps, along, wanted, options.passing)
            sides[1].set_axis_off()
            panels[0].tick_params(labelbottom=False)
            panels[0].set_xlabel("")
        if narrow:
            style.legend(panels[-1], options, handles)
        elif maps is not None:
            sides[1].legend(handles=handles, loc="center left", bbox_to_anchor=(-0.5, 0.5))
        else:
            style.legend(panels[0], options, handles, "below")
        style.rpm_axis(panels[0], atlas.sizes())
        if options.curve:
            curve_into(panels, atlas, along, BranchFile(options.curve))
        style.title(figure, atlas, lines[0].describe(without=[along]))
        style.save(figure, options)


def main(arguments_given):
    arguments = command_line.parser(__doc__)
    command_line.add_maps(arguments, "to draw the classes too")
    arguments.add_argument("--along", metavar="AXIS", help="the parameter to draw over (default: the first swept one)")
    arguments.add_argument("--passing", action="store_true", help="classes per blade passing")
    arguments.add_argument("--curve", metavar="BRANCH.h5", help="draw a curve of bifurcations over the map")
    command_line.run(draw, arguments.parse_args(arguments_given))

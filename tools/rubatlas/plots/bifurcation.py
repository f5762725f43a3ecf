"""Bifurcation diagram: Poincaré sections and maximum displacement over the speed ratio (as the paper's Fig. 3).

  rubatlas-plot bifurcation ATLAS.h5 -o PICTURE.png [--damping_ratio 0.1 ...] [--passing] [--zoom 0.22:0.335 ...]

Every dot is one section of the sampled revolutions: one dot is a motion that repeats itself each revolution, k dots
one that takes k revolutions, a cloud one that never repeats itself. A zoom is a panel of its own below: y at the
speeds of a range and, where the atlas has maps, the class of motion as a strip under it.
"""
import argparse

import numpy as np

from rubatlas import command_line
from rubatlas import style
from rubatlas.atlas_file import AtlasError, counted
from rubatlas.plots.map import class_cells_of, place_of


COLOURS = {"x": style.BLUE, "y": style.VERMILION}
STRIP = 0.05  # height of a strip of classes, in shares of its panel


def speed_range(word):
    """The type of a range of speed ratios."""
    try:
        low, high = map(float, word.split(":"))
    except ValueError:
        low = high = 0.0
    if not low < high:
        raise argparse.ArgumentTypeError(f"{word} is no range of speed ratios, such as 0.22:0.335")
    return low, high


def into(panel, line, component="x", name="poincare", shown=None, **look):
    """One component of the sections over the speed ratio; `shown`: at which speeds, by default at all of them."""
    atlas = line.atlas
    if component not in COLOURS:
        raise AtlasError(f"component {component!r}: x or y")
    units, factor = style.drawn(atlas.units(name))
    speed, sections = atlas.axis("speed_ratio"), line.rows(name)[:, :, "xy".index(component)]
    if shown is not None:
        speed, sections = speed[shown], sections[shown]
    panel.plot(np.repeat(speed, sections.shape[1]), factor * sections.ravel(), ".", markeredgewidth=0,
               rasterized=True, **{"color": COLOURS[component], "markersize": 1.3, "alpha": 0.6, **look})
    panel.set_ylabel(f"{component} at the section [{units}]")
    panel.set_xlabel(style.label(atlas, "speed_ratio"))


def zoom_into(panel, line, maps, zoom, name):
    """y at the sections within a range of speeds, and the classes of motion there; returns their legend."""
    atlas = line.atlas
    speed = atlas.axis("speed_ratio")
    shown = (speed >= zoom[0]) & (speed <= zoom[1])
    if shown.sum() < 2:
        raise AtlasError(f"--zoom {zoom[0]:g}:{zoom[1]:g}: {atlas.path} has {counted(shown.sum(), 'speeds')} there, "
                         f"and its speeds go from {speed[0]:g} to {speed[-1]:g}")
    into(panel, line, "y", name, shown, markersize=2.0)
    panel.set_xlim(zoom)
    if maps is None:
        return style.mark_missing(panel, speed, line.status())
    low, high = panel.get_ylim()
    panel.set_ylim(low - 2.0 * STRIP * (high - low), high)  # room for the strip
    strip = panel.inset_axes([0.0, 0.0, 1.0, STRIP], sharex=panel)
    cells = class_cells_of(maps, [line], "class" + name.removeprefix("poincare"))
    handles = style.cells_into(strip, [(entry, where[:, shown]) for entry, where in cells], place_of(speed[shown], 1))
    strip.set_axis_off()
    panel.set_xlim(zoom)
    return handles


def panels_of(options, heights):
    """A figure, its panels one below the other, and those of the zooms, in a row below if there is room."""
    count = len(options.zoom)
    rows, columns = ([2] * count, 1) if style.is_narrow(options) else ([3] * (count > 0), max(count, 1))
    figure = style.figure(options, (8.5, 1.05 * sum(heights + rows) + 0.6))
    grid = figure.add_gridspec(len(heights + rows), columns, height_ratios=heights + rows)
    panels = [figure.add_subplot(grid[row, :]) for row in range(len(heights))]
    for panel in panels[:-1]:
        panel.sharex(panels[-1])
        panel.tick_params(labelbottom=False)
    return figure, panels, [figure.add_subplot(place) for place in list(grid)[len(heights) * columns:]]


def draw(options):
    with command_line.atlas_with_maps(options, wants_maps=bool(options.zoom)) as (atlas, maps):
        line = atlas.line(**command_line.wanted(options, atlas.axes))
        name = "poincare_blade_passing" if options.passing else "poincare"
        speed = atlas.axis("speed_ratio")
        with_displacement = "max_displacement" in atlas

        figure, panels, zooms = panels_of(options, [3, 3, 2] if with_displacement else [3, 3])
        for panel, component in zip(panels, "xy"):
            into(panel, line, component, name)
            panel.set_xlabel("")
        if with_displacement:
            units, factor = style.drawn(atlas.units("max_displacement"))
            style.curve(panels[2], speed, factor * line.rows("max_displacement"), color=style.INK)
            panels[2].set_ylabel(f"max. displacement [{units}]")
            panels[2].set_ylim(bottom=0)
            clearance = factor * line.clearance
            if clearance > 0:
                panels[2].secondary_yaxis("right", functions=(lambda length: length / clearance,
                                                              lambda share: share * clearance)
                                          ).set_ylabel("/ clearance [-]")
        handles = style.mark_missing(panels, speed, line.status())
        panels[-1].set_xlabel(style.label(atlas, "speed_ratio"))
        style.rpm_axis(panels[0], atlas.sizes())
        style.legend(panels[-1 if style.is_narrow(options) else 0], options, handles, "upper left")
        panels[-1].set_xlim(*style.limits_of(speed))
        found = [handle for panel, zoom in zip(zooms, options.zoom)
                 for handle in zoom_into(panel, line, maps, zoom, name)]
        for zoom in options.zoom:
            panels[1].axvspan(*zoom, color=style.BEHIND, alpha=0.35, lw=0, zorder=0)
        if zooms:
            once_each = list({handle.get_label(): handle for handle in found}.values())
            style.legend(zooms[-1 if style.is_narrow(options) else 0], options, once_each, "below")
        once = "blade passing" if options.passing else "revolution"
        style.title(figure, atlas, f"One dot per {once}: {line.describe()}")
        style.save(figure, options)


def main(arguments_given):
    arguments = command_line.parser(__doc__)
    command_line.add_maps(arguments, "for the strips of the zooms")
    arguments.add_argument("--passing", action="store_true", help="sections at every blade passing")
    arguments.add_argument("--zoom", action="append", default=[], type=speed_range, metavar="FROM:TO",
                           help="a range of speed ratios to draw larger; may be repeated")
    command_line.run(draw, arguments.parse_args(arguments_given))

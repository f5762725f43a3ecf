"""Basins of attraction: which attractor each initial state leads to, speed by speed.

  rubatlas-plot basins ATLAS.h5 -o PICTURE.png [--maps MAPS.h5] [--at initial_y=0.001] [--at speed_ratio=0.438]
                       [--friction 0.1 ...]

The atlas has axes of the initial state; MAPS.h5 is what `rubatlas analyse ATLAS.h5 -o MAPS.h5` writes. Each speed has a
panel over two axes of the initial state (nine speeds at most, evenly chosen); a single axis is drawn over the speed
ratio. Attractors have the colours of their classes, and further ones of the same colour hatchings of their own.
"""
from typing import Any

import numpy as np

from rubatlas import command_line
from rubatlas import style
from rubatlas.atlas_file import AtlasError, AtlasFile
from rubatlas.palette import PALETTE
from rubatlas.same_scene import require_maps_of

MOST_PANELS = 9
# Hatchings of the second attractor of one colour, the third and so on.
FURTHER = ["|", "o", "+", "*", "O"]


def class_name(motion):
    return {254: "unresolved", 255: "aperiodic"}.get(motion, f"period {motion}")


def cells_of(attractor, motion, status):
    """Which points lead to which attractor, with its look and its share; and those that have none or are not done."""
    found, seen = [], dict[str, int]()
    for number in range(1, attractor.max(initial=0) + 1):
        where = attractor == number
        kind = int(motion[where][0])
        entry = next(entry for entry in PALETTE["classes"] if entry["first"] <= kind <= entry["last"])
        further = seen.setdefault(entry["name"], 0)  # attractors of this look so far
        seen[entry["name"]] += 1
        hatch = entry.get("hatch", "") + ("" if further == 0 else FURTHER[(further - 1) % len(FURTHER)])
        found.append(({"name": f"{number}: {class_name(kind)}, {100 * np.mean(where):.1f} %", "colour": entry["colour"],
                       "hatch": hatch}, where))
    return [*found, *style.class_cells(np.where(attractor > 0, 0, motion), status)]


def place_of(atlas, horizontal, vertical):
    return [style.edges_of(style.drawn(atlas.units(name))[1] * atlas.axis(name)) for name in (horizontal, vertical)]


def draw(options):
    with AtlasFile(options.source) as atlas, AtlasFile(command_line.maps_of(options, required=True)) as maps:
        require_maps_of(atlas, maps)
        wanted = command_line.wanted(options, atlas.axes)
        starts = [name for name in atlas.axes if name.startswith("initial_") and len(atlas.axis(name)) > 1]
        free = [name for name in starts if name not in wanted][:2]
        if not free:
            raise AtlasError(f"{options.source}: no axis of the initial state is left to draw over; "
                             f"the atlas has {', '.join(atlas.axes)}")
        vertical, horizontal = free if len(free) == 2 else (free[0], "speed_ratio")
        speed = atlas.axis("speed_ratio")
        places = list(range(len(speed)))
        if "speed_ratio" in wanted:
            places = [atlas.index("speed_ratio", wanted.pop("speed_ratio"))]
        elif len(places) > MOST_PANELS:
            places = [int(place) for place in np.linspace(0, len(speed) - 1, MOST_PANELS).round()]
        line = atlas.line(**wanted)
        chosen = [slice(None) if name in free else place for name, place in zip(atlas.axes, line.index)]
        status, motion, attractor = (np.asarray(file.dataset(name)[tuple(chosen)]) for file, name in
                                     ((atlas, "status"), (maps, "class"), (maps, "attractor")))

        over_speed = horizontal == "speed_ratio"
        panels: list[tuple[Any, str]] = [(slice(None), "")] if over_speed else \
            [((slice(None), slice(None), place), f"Ω = {speed[place]:g}") for place in places]
        columns = min(3, len(panels))
        rows = -(-len(panels) // columns)
        figure, grid = style.subplots(options, rows, columns, (9.5, 1.2 + rows * (4.2 if columns < 3 else 4.0)),
                                      sharex=True, sharey=True)
        for panel, (at, name) in zip(grid.flat, panels):
            cells = cells_of(attractor[at], motion[at], status[at])
            handles = style.cells_into(panel, cells, place_of(atlas, horizontal, vertical))
            panel.grid(False)
            panel.set_xlabel(style.label(atlas, horizontal))
            panel.set_ylabel(style.label(atlas, vertical))
            panel.label_outer()
            panel.set_title(name)
            style.legend(panel, options, handles, "below")
        for panel in grid.flat[len(panels):]:
            panel.set_axis_off()
        shown = "" if over_speed or len(places) in (1, len(speed)) else f"; {len(places)} of {len(speed)} speeds"
        words = line.describe(without=starts if over_speed else free) + shown
        first = panels[0][1]
        style.title(figure, atlas, f"{words}\n\n{first}" if len(panels) > 1 else f"{words}, {first}".rstrip(", "))
        style.save(figure, options)


def main(arguments_given):
    arguments = command_line.parser(__doc__)
    command_line.add_maps(arguments, "which have the attractors")
    command_line.run(draw, arguments.parse_args(arguments_given))

"""Basins of attraction: which attractor each initial state leads to, speed by speed.

  rubatlas-plot basins ATLAS.h5 -o PICTURE.png [--maps MAPS.h5] [--at initial_y=0.001] [--at speed_ratio=0.438]
                       [--friction 0.1 ...]

The atlas has axes of the initial state; MAPS.h5 is what `rubatlas analyse ATLAS.h5 -o MAPS.h5` writes. Each speed has a
panel over two axes of the initial state (nine speeds at most, evenly chosen); a single axis is drawn over the speed
ratio. Attractors have the colours of their classes, and further ones of the same class colours of their own.
"""
from typing import Any

import numpy as np
from matplotlib.patches import Patch

from rubatlas import command_line
from rubatlas import style
from rubatlas.atlas_file import AtlasError, AtlasFile
from rubatlas.same_scene import require_same

MOST_PANELS = 9


def class_name(motion):
    return {254: "unresolved", 255: "aperiodic"}.get(motion, f"period {motion}")


def entries(attractor, motion):
    """(number, class, colour) of each attractor of a panel, in the order of their numbers."""
    spare, used, found = iter([style.VERMILION, style.SKY, style.BLUE, style.GREY] * 64), set(), []
    for number in range(1, attractor.max(initial=0) + 1):
        kind = int(motion[attractor == number][0])
        colour = next(colour for _, colour, first, last in style.CLASSES if first <= kind <= last)
        if colour in used:
            colour = next(spare)
        used.add(colour)
        found.append((number, kind, colour))
    return found


def image_of(attractor, motion, status):
    """Colours (..., 3) of the attractors of a panel, and its legend with their shares."""
    image, handles = style.class_image(np.where(attractor > 0, 0, motion), status)
    share = {number: np.mean(attractor == number) for number in range(attractor.max(initial=0) + 1)}
    own = []
    for number, kind, colour in entries(attractor, motion):
        image[attractor == number] = style.matplotlib.colors.to_rgb(colour)
        own.append(Patch(facecolor=colour, edgecolor="#55556a", lw=0.5,
                         label=f"{number}: {class_name(kind)}, {100 * share[number]:.1f} %"))
    return image, own + handles


def place_of(atlas, horizontal, vertical):
    borders = [style.edges_of(style.drawn(atlas.units(name))[1] * atlas.axis(name)) for name in (horizontal, vertical)]
    return dict(origin="lower", aspect="auto", interpolation="nearest",
                extent=(*borders[0][[0, -1]], *borders[1][[0, -1]]))


def draw(options):
    with AtlasFile(options.source) as atlas, AtlasFile(command_line.maps_of(options, required=True)) as maps:
        require_same(atlas.path, atlas.scene, maps.path, maps.scene)
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
        panels: list[tuple[Any, str | None]] = [(slice(None), None)] if over_speed else \
            [((slice(None), slice(None), place), f"Ω = {speed[place]:g}") for place in places]
        columns = min(3, len(panels))
        rows = -(-len(panels) // columns)
        figure, grid = style.plt.subplots(rows, columns, squeeze=False, sharex=True, sharey=True,
                                          figsize=(9.5, 1.2 + rows * (4.2 if columns < 3 else 4.0)))
        for panel, (at, name) in zip(grid.flat, panels):
            image, handles = image_of(attractor[at], motion[at], status[at])
            panel.imshow(image, **place_of(atlas, horizontal, vertical))
            panel.grid(False)
            # The name stands with the legend, since the picture's second line takes the place of a title.
            panel.legend(handles=handles, title=name, loc="upper center", bbox_to_anchor=(0.5, -0.16), fontsize=8)
        for panel in grid.flat[len(panels):]:
            panel.set_axis_off()
        for panel in grid[-1, :]:
            panel.set_xlabel(style.label(atlas, horizontal))
        for panel in grid[:, 0]:
            panel.set_ylabel(style.label(atlas, vertical))
        shown = "" if over_speed or len(places) in (1, len(speed)) else f"; {len(places)} of {len(speed)} speeds"
        style.title(figure, atlas, line.describe(without=starts if over_speed else free) + shown)
        style.save(figure, options)


def main(arguments_given):
    arguments = command_line.parser(__doc__)
    command_line.add_maps(arguments, "which have the attractors")
    command_line.run(draw, arguments.parse_args(arguments_given))

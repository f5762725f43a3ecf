"""Sensitivity map: maximum displacement, and class of motion, over the speed ratio and one parameter.

  rubatlas-plot map ATLAS.h5 -o PICTURE.png [--maps MAPS.h5] [--along damping_ratio] [--passing]

The classes come from the file that `rubatlas analyse ATLAS.h5 -o MAPS.h5` writes; without it only the displacement is
drawn. Rows are as high as each other, whatever the distance of their values.
"""
import numpy as np

from rubatlas import command_line
from rubatlas import style
from rubatlas.atlas_file import AtlasError, AtlasFile
from rubatlas.same_scene import require_same


def draw(options):
    with AtlasFile(options.source) as atlas:
        wanted = command_line.wanted(options, atlas.axes)
        swept = [axis for axis in atlas.swept_axes() if axis not in wanted]
        along = options.along or (swept[0] if swept else atlas.axes[-2])
        if along not in atlas.axes[:-1]:
            raise AtlasError(f"{along} is no axis of {options.source}, which has {', '.join(atlas.axes[:-1])}")
        lines, speed = atlas.lines(along, **wanted), atlas.axis("speed_ratio")
        units, factor = style.drawn(atlas.units("max_displacement"))
        displacement = factor * np.array([line.rows("max_displacement") for line in lines])
        status = np.array([line.status() for line in lines])
        classes = None
        if options.maps:
            with AtlasFile(options.maps) as maps:
                require_same(atlas.path, atlas.scene, maps.path, maps.scene)
                name = "class_blade_passing" if options.passing else "class"
                classes = np.array([line.raw(name) for line in maps.lines(along, **wanted)])

        count = 1 if classes is None else 2
        figure = style.plt.figure(figsize=(9.5, 1.3 + count * max(1.6, 0.32 * len(lines) + 0.6)))
        grid = figure.add_gridspec(count, 2, width_ratios=[1, 0.02])
        panels = [figure.add_subplot(grid[row, 0]) for row in range(count)]
        sides = [figure.add_subplot(grid[row, 1]) for row in range(count)]
        half = 0.5 * (speed[1] - speed[0]) if len(speed) > 1 else 0.01
        place = dict(origin="lower", aspect="auto", interpolation="nearest",
                     extent=(speed[0] - half, speed[-1] + half, -0.5, len(lines) - 0.5))
        # Logarithmic, over three decades: the small motion below the first trigger has a structure of its own.
        largest = np.nanmax(displacement, initial=0.0) or 1.0
        image = panels[0].imshow(np.ma.masked_invalid(np.maximum(displacement, 1e-3 * largest)), cmap=style.SEQUENTIAL,
                                 norm=style.matplotlib.colors.LogNorm(1e-3 * largest, largest), **place)
        panels[0].imshow(style.missing_image(status), **place)
        figure.colorbar(image, cax=sides[0], label=f"Max. displacement [{units}]")
        if classes is not None:
            class_image, handles = style.class_image(classes, status)
            panels[1].imshow(class_image, **place)
            panels[1].set_title("Class of motion, in blade passings" if options.passing else
                                "Class of motion, in revolutions", loc="left", fontsize=9, color="#55556a")
            sides[1].legend(handles=handles, loc="center left", bbox_to_anchor=(-0.5, 0.5))
            sides[1].set_axis_off()
            panels[0].tick_params(labelbottom=False)
        values, scale = atlas.axis(along), style.drawn(atlas.units(along))[1]
        for panel in panels:
            panel.grid(False)
            panel.set_yticks(range(len(lines)), [format(scale * value, "g") for value in values])
            panel.set_yticks(np.arange(len(lines) - 1) + 0.5, minor=True)
            panel.grid(True, axis="y", which="minor", color="white", lw=1.2)
            panel.tick_params(which="minor", length=0)
            panel.set_axisbelow(False)
            panel.set_ylabel(style.label(atlas, along))
        panels[-1].set_xlabel(style.label(atlas, "speed_ratio"))
        style.title(figure, atlas, lines[0].describe(without=[along]))
        style.save(figure, options)


def main(arguments_given):
    arguments = command_line.parser(__doc__)
    arguments.add_argument("--maps", metavar="MAPS.h5", help="draw the classes too")
    arguments.add_argument("--along", metavar="AXIS", help="the parameter to draw over (default: the first swept one)")
    arguments.add_argument("--passing", action="store_true", help="classes per blade passing")
    command_line.run(draw, arguments.parse_args(arguments_given))

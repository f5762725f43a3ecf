"""How an effect changes a bifurcation diagram: the same scene without it and with it, side by side.

  rubatlas-plot effect WITH.h5 --without WITHOUT.h5 -o PICTURE.png [--damping_ratio 0.1 ...]

Above, y at the Poincaré sections; below, the maximum displacement, on the right with that of the left behind it.
jobs/effects.sh makes both atlases from a scene that has an effect, and draws them.
"""
import numpy as np

from rubatlas import command_line
from rubatlas import style
from rubatlas.atlas_file import AtlasFile
from rubatlas.same_scene import require_without_effect


def draw(options):
    with AtlasFile(options.source) as atlas, AtlasFile(options.without) as plain:
        require_without_effect(atlas.path, atlas.scene, plain.path, plain.scene)
        figure, panels = style.subplots(options, 2, 2, (9.5, 4.6), [3, 2], sharex=True, sharey=True)
        units, factor = style.drawn(atlas.units("max_displacement"))
        curves = []
        for column, (source, name) in enumerate(((plain, "without"), (atlas, "with"))):
            line = source.line(**command_line.wanted(options, source.axes))
            speed, sections = source.axis("speed_ratio"), line.rows("poincare")
            panels[0, column].plot(np.repeat(speed, sections.shape[1]), factor * sections[:, :, 1].ravel(), ".",
                                   color=(style.BLUE, style.VERMILION)[column], markersize=1.6, markeredgewidth=0,
                                   alpha=0.6, rasterized=True)
            curves.append((name, speed, factor * line.rows("max_displacement")))
            for (label, x, y), colour in zip(curves[::-1], (style.INK, style.GREY)):
                style.curve(panels[1, column], x, y, label=label, color=colour, zorder=2 if colour == style.INK else 1)
            handles = [*panels[1, column].get_legend_handles_labels()[0],
                       *style.mark_missing(panels[:, column], speed, line.status())]
            panels[1, column].set_xlabel(style.label(source, "speed_ratio"))
            panels[1, column].label_outer()
            style.legend(panels[1, column], options, handles, "upper left")
            panels[0, column].set_xlim(*style.limits_of(speed))
            panels[0, column].set_title(name, loc="right")
            style.rpm_axis(panels[0, column], source.sizes())
        style.label_row(options, panels[0], f"y at the section [{units}]")
        style.label_row(options, panels[1], f"max. displacement [{units}]")
        panels[1, 0].set_ylim(bottom=0)
        style.title(figure, atlas, "One dot per revolution")
        style.save(figure, options)


def main(arguments_given):
    arguments = command_line.parser(__doc__, source="WITH.h5")
    arguments.add_argument("--without", required=True, metavar="WITHOUT.h5",
                           help="atlas of the scene without the effect")
    command_line.run(draw, arguments.parse_args(arguments_given))

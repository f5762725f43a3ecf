"""Bifurcation diagram: Poincaré sections and maximum displacement over the speed ratio (as the paper's Fig. 3).

  rubatlas-plot bifurcation ATLAS.h5 -o PICTURE.png [--damping_ratio 0.1 ...] [--passing]

Every dot is one section of the sampled revolutions: one dot is a motion that repeats itself each revolution, k dots
one that takes k revolutions, a cloud one that never repeats itself.
"""
import numpy as np

from rubatlas import command_line
from rubatlas import style
from rubatlas.atlas_file import AtlasError, AtlasFile


COLOURS = {"x": style.BLUE, "y": style.VERMILION}


def into(panel, line, component="x", name="poincare"):
    """One component of the sections over the speed ratio."""
    atlas = line.atlas
    if component not in COLOURS:
        raise AtlasError(f"component {component!r}: x or y")
    units, factor = style.drawn(atlas.units(name))
    sections = line.rows(name)[:, :, "xy".index(component)]
    panel.plot(np.repeat(atlas.axis("speed_ratio"), sections.shape[1]), factor * sections.ravel(), ".",
               color=COLOURS[component],
               markersize=1.3, markeredgewidth=0, alpha=0.6, rasterized=True)
    panel.set_ylabel(f"{component} at the section [{units}]")
    panel.set_xlabel(style.label(atlas, "speed_ratio"))


def draw(options):
    with AtlasFile(options.source) as atlas:
        line = atlas.line(**command_line.wanted(options, atlas.axes))
        name = "poincare_blade_passing" if options.passing else "poincare"
        speed = atlas.axis("speed_ratio")
        with_displacement = "max_displacement" in atlas

        heights = [3, 3, 2] if with_displacement else [3, 3]
        figure, grid = style.subplots(options, len(heights), 1, (8.5, 1.05 * sum(heights) + 0.6), heights, sharex=True)
        panels = grid[:, 0]
        for panel, component in zip(panels, "xy"):
            into(panel, line, component, name)
            panel.set_xlabel("")
        if with_displacement:
            units, factor = style.drawn(atlas.units("max_displacement"))
            panels[2].plot(speed, factor * line.rows("max_displacement"), color=style.INK, lw=0.9)
            panels[2].set_ylabel(f"max. displacement [{units}]")
            panels[2].set_ylim(bottom=0)
        handles = style.mark_missing(panels, speed, line.status())
        panels[-1].set_xlabel(style.label(atlas, "speed_ratio"))
        style.rpm_axis(panels[0], atlas.sizes())
        style.legend(panels[-1 if style.is_narrow(options) else 0], options, handles, "upper left")
        panels[-1].set_xlim(speed[0], speed[-1])
        once = "blade passing" if options.passing else "revolution"
        style.title(figure, atlas, f"One dot per {once}: {line.describe()}")
        style.save(figure, options)


def main(arguments_given):
    arguments = command_line.parser(__doc__)
    arguments.add_argument("--passing", action="store_true", help="sections at every blade passing")
    command_line.run(draw, arguments.parse_args(arguments_given))

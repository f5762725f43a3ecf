"""Stacked bifurcation diagrams over the speed ratio, one for each value of a parameter (as the paper's Fig. 4).

  rubatlas-plot stack ATLAS.h5 -o PICTURE.png [--maps MAPS.h5] [--along damping_ratio] [--values 0.01,0.05,0.1]

Dots as in a bifurcation diagram, on the same scale in all panels. Where the atlas has maps (`rubatlas analyse`), the
dots of aperiodic motions are lighter, so that periodic windows stand out.
"""

from rubatlas import command_line
from rubatlas import style
from rubatlas.atlas_file import SYMBOL
from rubatlas.judgement import APERIODIC_CLASS
from rubatlas.plots import bifurcation
from rubatlas.plots.displacement import along_of
from rubatlas.plots.map import rows_of, value_of

LIGHTER = {"x": "#a6cce4", "y": "#f0bb94"}  # for dots of aperiodic motions


def into(panel, line, component, aperiodic=None):
    """The sections of a line; those of the points that are `aperiodic` lighter, and behind the others."""
    if aperiodic is None:
        bifurcation.into(panel, line, component)
        return
    bifurcation.into(panel, line, component, shown=aperiodic, color=LIGHTER[component], alpha=1.0)
    bifurcation.into(panel, line, component, shown=~aperiodic, alpha=1.0)


def name_of(line, along):
    """A line's value of the parameter, with its symbol, or its name above."""
    name = f"{SYMBOL[along]} = " if along in SYMBOL else along.replace("_", " ") + "\n"
    units = style.drawn(line.atlas.units(along))[0]
    return name + value_of(line, along) + ("" if units == "-" else f" {units}")


def draw(options):
    with command_line.atlas_with_maps(options) as (atlas, maps):
        wanted = command_line.wanted(options, atlas.axes)
        along, lines, _ = rows_of(atlas, along_of(atlas, options.along, wanted), wanted)
        if options.values:
            lines = [atlas.line(**{**wanted, along: value}) for value in options.values.split(",")]

        figure, grid = style.subplots(options, len(lines), 1, (8.5, 1.1 + min(12.0, 0.95 * len(lines))), sharex=True)
        panels, speed = grid[:, 0], atlas.axis("speed_ratio")
        for panel, line in zip(panels, lines):
            if panel is not panels[0]:
                panel.sharey(panels[0])
            into(panel, line, options.component,
                 None if maps is None else maps.dataset("class")[line.index] == APERIODIC_CLASS)
            words = panel.get_ylabel()
            panel.set_xlabel("")
            panel.yaxis.set_label_position("right")
            panel.set_ylabel(name_of(line, along), rotation=0, ha="left", va="center")
        handles = {handle.get_label(): handle for panel, line in zip(panels, lines)
                   for handle in style.mark_missing(panel, speed, line.status())}
        if maps:
            dots = {"marker": ".", "ls": "none", "ms": 8, "mew": 0}
            for name, colours in (("periodic, or unresolved", bifurcation.COLOURS), ("aperiodic", LIGHTER)):
                handles[name] = style.plt.Line2D([], [], color=colours[options.component], label=name, **dots)
        panels[0].locator_params(axis="y", nbins=4)
        panels[0].set_xlim(*style.limits_of(speed))
        panels[-1].set_xlabel(style.label(atlas, "speed_ratio"))
        figure.supylabel(words, fontsize=style.plt.rcParams["axes.labelsize"])
        style.legend(panels[-1], options, list(handles.values()), "below")
        style.rpm_axis(panels[0], atlas.sizes())
        style.title(figure, atlas, f"One dot per revolution: {lines[0].describe(without=[along])}")
        style.save(figure, options)


def main(arguments_given):
    arguments = command_line.parser(__doc__)
    command_line.add_maps(arguments, "which tell aperiodic motions")
    arguments.add_argument("--along", metavar="AXIS", help="the parameter with a panel per value "
                                                           "(default: the first swept one)")
    arguments.add_argument("--values", metavar="VALUE,...", help="the values to draw (default: all of the atlas)")
    arguments.add_argument("--component", choices=("x", "y"), default="y", help="what to draw (default: y)")
    command_line.run(draw, arguments.parse_args(arguments_given))

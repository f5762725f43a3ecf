"""Maximum displacement over the clearance, along the speed ratio.

  rubatlas-plot displacement ATLAS.h5 -o PICTURE.png [--along damping_ratio] [--friction 0.1 ...]

One curve per value of the swept parameter; above 1 the rotor moves further than the gap between blade and ring. Speeds
without a motion are shaded, the fainter the fewer lines have none there.
"""
from rubatlas import command_line
from rubatlas import style
from rubatlas.atlas_file import AtlasError, AtlasFile


def into(panel, atlas, along, wanted):
    """One curve for each value of `along`, or one curve; returns the lines and the marks of speeds without a motion."""
    if along is not None and along not in atlas.axes[:-1]:
        raise AtlasError(f"{along} is no axis of {atlas.path}, which has {', '.join(atlas.axes[:-1])}")
    lines = atlas.lines(along, **wanted) if along else [atlas.line(**wanted)]
    if min(line.clearance for line in lines) <= 0:
        raise AtlasError(f"{atlas.path}: this rotor has no clearance to relate the displacement to")
    speed = atlas.axis("speed_ratio")
    # Ordered values get ordered colours; the map ends in a yellow that is too light for a thin line.
    colours = style.plt.get_cmap(style.SEQUENTIAL)([0.92 * i / max(1, len(lines) - 1) for i in range(len(lines))])
    for line, colour in zip(lines, colours):
        name = line.describe(without=[axis for axis in atlas.axes[:-1] if axis != along]) if along else None
        style.curve(panel, speed, line.rows("max_displacement") / line.clearance, color=colour, label=name)
    gaps = style.mark_missing(panel, speed, [line.status() for line in lines])
    panel.axhline(1.0, color=style.GREY, lw=0.8, ls=(0, (4, 3)))
    panel.set_xlabel(style.label(atlas, "speed_ratio"))
    panel.set_ylabel("Maximum displacement / clearance [-]")
    panel.set_xlim(*style.limits_of(speed))
    panel.set_ylim(bottom=0)
    return lines, gaps


def along_of(atlas, along, wanted):
    """The parameter to draw along: the one that is named, or the first that is swept."""
    if along in wanted:
        raise AtlasError(f"along {along}: all of its values are drawn, not one of them")
    swept = [axis for axis in atlas.swept_axes() if axis not in wanted]
    return along or (swept[0] if swept else None)


def draw(options):
    with AtlasFile(options.source) as atlas:
        wanted = command_line.wanted(options, atlas.axes)
        along = along_of(atlas, options.along, wanted)
        figure, ((panel,),) = style.subplots(options, 1, 1, (9.5, 4.6))
        lines, gaps = into(panel, atlas, along, wanted)
        style.rpm_axis(panel, atlas.sizes())
        clearances = [line.clearance for line in lines]
        named = panel.get_legend_handles_labels()[0] if along else []
        style.legend(panel, options, [*named, *gaps])
        fixed = lines[0].describe(without=[along] if along else [])
        widths = " to ".join(dict.fromkeys(f"{1e3 * width:g}" for width in (min(clearances), max(clearances))))
        style.title(figure, atlas, f"{fixed}; clearance {widths} mm")
        style.save(figure, options)


def main(arguments_given):
    arguments = command_line.parser(__doc__)
    arguments.add_argument("--along", metavar="AXIS", help="the parameter with one curve per value "
                                                           "(default: the first swept one)")
    command_line.run(draw, arguments.parse_args(arguments_given))

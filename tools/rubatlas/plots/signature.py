"""Signs of rubbing in the spectrum over the speed, and whether they come before the displacement passes a limit.

  rubatlas-plot signature ATLAS.h5 -o PICTURE.png [--maps MAPS.h5] [--damping_ratio 0.1 ...]

From above: the heights of the n× line, of the broad band and of the highest line between the whole orders, down to a
thousandth of the limit; the share of the power between the whole orders; the maximum displacement with the limit.
Across all of them, the speed at which the earliest sign that stays announces the limit, and that at which it is passed,
as `rubatlas analyse --limit "0.5 mm"` has found them for the maps.
"""
import numpy as np

from rubatlas import command_line
from rubatlas import style
from rubatlas.atlas_file import AtlasError, AtlasFile
from rubatlas.same_scene import require_maps_of
from rubatlas.signature import signature


LEAST = 1e-3  # that can be seen: of the limit, and of the power


def found_of(maps, line):
    """What the maps say of a line: the columns of their table /signature at its row."""
    if "signature" not in maps:
        raise AtlasError(f"{maps.path}: it has no /signature; `rubatlas analyse` writes it for lines from one initial "
                         "state, of atlases with max_displacement and a spectrum of eight revolutions or more up to "
                         "twice the blade passing")
    row = np.ravel_multi_index(line.index, [len(maps.axis(name)) for name in maps.axes[:-1]])
    return {name: column[row] for name, column in maps.file["signature"].items() if name != "line"}


def into(panels, line, found):
    """Draws a line's spectra and displacement into three panels; returns the marks of speeds without a motion."""
    heights, share, displacement = panels
    atlas, blades = line.atlas, line.scene["blades"]["count"]
    speed, (units, factor) = atlas.axis("speed_ratio"), style.drawn(atlas.units("spectrum"))
    measured = signature(atlas.axis("order"), line.rows("spectrum"), blades)
    floor = LEAST * factor * found["limit"]
    lines = np.array([measured.passing, measured.broad, measured.subharmonic])
    style.say_if_below(heights, factor * lines, floor, f" {units}")
    style.say_if_below(share, measured.between_share, LEAST)
    style.say_if_below(displacement, factor * line.rows("max_displacement"), floor, f" {units}")
    for values, name, colour in ((measured.passing, f"{blades}× line", style.VERMILION),
                                 (measured.broad, "broad band", style.SKY),
                                 (measured.subharmonic, "highest line between the whole orders", style.INK)):
        style.curve(heights, speed, np.maximum(factor * values, floor), color=colour, label=name)
    heights.set_yscale("log")
    heights.set_ylim(bottom=floor)
    heights.set_ylabel(f"Amplitude [{units}]")
    style.curve(share, speed, measured.between_share, color=style.BLUE)
    share.set_ylabel("Share of power\nbetween [-]")
    share.set_ylim(0.0, 1.0)
    style.curve(displacement, speed, factor * line.rows("max_displacement"), color=style.BLUE)
    displacement.axhline(factor * found["limit"], color=style.INK, lw=0.9, ls=(0, (4, 3)))
    displacement.set_ylabel(f"Maximum displacement [{units}]")
    displacement.set_ylim(bottom=0.0)
    displacement.set_xlabel(style.label(atlas, "speed_ratio"))
    displacement.set_xlim(*style.limits_of(speed))
    for column, name, colour in (("announced_speed_ratio", "announced", style.GREEN),
                                 ("limit_speed_ratio", "limit passed", style.PURPLE)):
        if np.isfinite(found[column]):
            for panel in panels:
                panel.axvline(found[column], color=colour, lw=1.2,
                              label=f"{name}, Ω = {found[column]:.3f}" if panel is heights else None)
    return style.mark_missing(panels, speed, line.status())


def draw(options):
    with AtlasFile(options.source) as atlas, AtlasFile(command_line.maps_of(options, required=True)) as maps:
        require_maps_of(atlas, maps)
        line = atlas.line(**command_line.wanted(options, atlas.axes))
        figure, panels = style.subplots(options, 3, 1, (9.5, 7.2), heights=[2, 1, 2], sharex=True)
        found = found_of(maps, line)
        gaps = into(panels[:, 0], line, found)
        style.legend(panels[-1, 0], options, [*panels[0, 0].get_legend_handles_labels()[0], *gaps], "below")
        style.rpm_axis(panels[0, 0], atlas.sizes())
        style.title(figure, atlas, f"{line.describe()}; limit {1e3 * found['limit']:g} mm")
        style.save(figure, options)


def main(arguments_given):
    arguments = command_line.parser(__doc__)
    command_line.add_maps(arguments, "which have the signs")
    command_line.run(draw, arguments.parse_args(arguments_given))

"""Speeds at which a rotor keeps given limits for all values of the other quantities, as bands.

  rubatlas-plot safe_speeds ATLAS.h5 -o PICTURE.png --keep "max_displacement<=12 mm" --keep "max_root_strain<=0.2 %"
                       [--keep "nearest_miss>=0.1 mm"] [--maps MAPS.h5 --keep "margin>=10 rpm" --keep "class<=1"]
                       [--operate "540 rpm"] [--least-width 0.01] [--aperiodic] [--json BANDS.json]
                       [--damping_ratio 0.1 ...]

A limit names a dataset of the atlas with one number per point, or one of the maps that `rubatlas analyse` writes:
`class`, or `margin`, the distance in speed ratio to the nearest change of motion. Its number has a unit (mm, N, %,
clearances; for speeds and margins rpm, Hz, rad/s), or is in the dataset's own, which is SI. A speed is safe if every
line of the atlas, or every one at the values named by options, keeps every limit there. What does not occur keeps its
limit: a miss where no tip passes the ring, a margin where the motion never changes. A point that is not done keeps
none, and an aperiodic motion none either, since its largest values are those of a sample; --aperiodic lets it, and so
does a limit on the class.

A band reaches from its first to its last safe speed of the grid, of which one alone is no band; nothing is said of the
step beyond. Its separation margin is the percentage by which the speed may be off on either side at its middle, and
that of --operate the percentage to the nearest speed that is not safe. An end is open where the grid ends, or where
points are not done. Where a motion leaves the model it is not. All this is said of the motions that the atlas has: of
one sweep, unless the scene has "sweep": "both", in which the other motion at a speed is looked at, too.
"""
import json
import os
import pathlib

import numpy as np

from rubatlas import command_line
from rubatlas import style
from rubatlas.atlas_file import AtlasError
from rubatlas.judgement import Judgement, bands_of


def lines_of(atlas, wanted):
    """Places of all lines at the values that the user has named."""
    unknown = set(wanted) - set(atlas.axes[:-1])
    if unknown:
        raise AtlasError(f"{atlas.path}: no axis {', '.join(sorted(unknown))}; "
                         f"a line is picked by {', '.join(atlas.axes[:-1])}")
    choices = [[atlas.index(name, wanted[name])] if name in wanted else range(len(atlas.axis(name)))
               for name in atlas.axes[:-1]]
    return np.ix_(*choices, range(len(atlas.axis("speed_ratio"))))


def require_json_place(options):
    """A JSON file is new, or replaces bands."""
    if options.json is None:
        return
    path = pathlib.Path(options.json)
    if path.suffix != ".json" or not path.parent.is_dir():
        raise AtlasError(f"--json {path}: must be a file that ends in .json, in a folder that is there")
    if path.exists():
        try:
            replaceable = "bands" in json.loads(path.read_text(encoding="utf-8"))
        except (OSError, ValueError, TypeError):
            replaceable = False
        if not replaceable:
            raise AtlasError(f"--json {path}: this file is there and holds no bands; bands replace bands only")


def draw_picture(atlas, judgement, options, what):
    limits = judgement.limits
    figure, panels = style.subplots(options, len(limits), 1, (9.5, 1.3 + 1.8 * len(limits)), sharex=True)
    border = style.edges_of(judgement.speed)
    for panel, limit in zip(panels[:, 0], limits):
        unit, factor = style.drawn(limit.units)
        for first, last in bands_of(judgement.safe):
            panel.axvspan(*judgement.speed[[first, last]], color=style.GREEN, alpha=0.18, lw=0, zorder=0)
        for first, last in bands_of(judgement.aperiodic):
            panel.axvspan(*border[[first, last + 1]], color=style.INK, alpha=0.1, lw=0, zorder=0)
        gaps = style.mark_missing(panel, judgement.speed, judgement.status)
        style.curve(panel, judgement.speed, factor * limit.worst(), color=style.BLUE)
        panel.axhline(factor * limit.bound, color=style.VERMILION, lw=0.9, ls=(0, (4, 3)))
        panel.set_ylabel(f"{limit.name.replace('_', ' ')} [{unit}]")
        positive = limit.values[np.isfinite(limit.values) & (limit.values > 0)]
        if (limit.sign == ">=" or limit.name == "class") and len(positive) and limit.bound > 0:
            panel.set_yscale("log")  # what must not become small is looked at by its decades, and 255 is aperiodic
            panel.set_ylim(bottom=max(positive.min(), 1e-3 * limit.bound) * factor / 1.2)  # above what is rounding
        if limit.name == "class":
            panel.set_yticks([1, 2, 4, 16, 255], ["1", "2", "4", "16", "aperiodic"])
            panel.minorticks_off()
        if options.operate is not None:
            panel.axvline(judgement.speed_of(options.operate), color=style.INK, lw=0.9)
    handles = [style.Patch(color=style.GREEN, alpha=0.18, label=f"every limit is kept\nin {judgement.sweeps()}"),
               *([style.Patch(color=style.INK, alpha=0.1, label="aperiodic motion,\nwhich is in no band")]
                 if judgement.aperiodic.any() else []),
               style.plt.Line2D([], [], color=style.BLUE, lw=0.9, label="the line nearest to the limit"),
               style.plt.Line2D([], [], color=style.VERMILION, lw=0.9, ls=(0, (4, 3)), label="limit")]
    if options.operate is not None:
        shown = judgement.shown(judgement.speed_of(options.operate)).replace(" (", "\n(")
        handles.append(style.plt.Line2D([], [], color=style.INK, lw=0.9, label=f"operating speed {shown}"))
    panels[-1, 0].set_xlabel(style.label(atlas, "speed_ratio"))
    style.legend(panels[-1 if style.is_narrow(options) else 0, 0], options, [*handles, *gaps])
    style.rpm_axis(panels[0, 0], judgement.sizes)
    panels[-1, 0].set_xlim(*style.limits_of(judgement.speed))
    style.title(figure, atlas, f"Safe for {what}, in {judgement.sweeps()}")
    style.save(figure, options)


def draw(options):
    require_json_place(options)
    with command_line.atlas_with_maps(options) as (atlas, maps):
        wanted = command_line.wanted(options, atlas.axes)
        judgement = Judgement(atlas, maps, options.keep, lines_of(atlas, wanted), aperiodic=options.aperiodic,
                              least_width=options.least_width)
        # Which sweep is judged the judgement says itself.
        held = [f"{name.replace('_', ' ')} {value:g}" for name, value in wanted.items() if name != "direction"]
        every = [name.replace("_", " ") for name in atlas.swept_axes() if name not in (*wanted, "direction")]
        fixed = ", ".join([*held, *([f"every {' and '.join(every)}"] if every else [])]) or "the one line of the atlas"
        result = {"atlas": os.path.basename(atlas.path), "lines": len(judgement.status), "for": fixed,
                  **judgement.result(options.operate)}
        draw_picture(atlas, judgement, options, fixed)
        if options.json:
            command_line.write_complete(pathlib.Path(options.json),
                                        (json.dumps(result, indent=2, ensure_ascii=False) + "\n").encode())
        print(*judgement.sentences(result), sep="\n")


def main(arguments_given):
    arguments = command_line.parser(__doc__)
    arguments.add_argument("--keep", action="append", required=True, metavar="LIMIT",
                           help='a limit such as "max_displacement<=12 mm"; may be repeated')
    command_line.add_maps(arguments, "for limits on margin and class, and to leave aperiodic motions out")
    arguments.add_argument("--operate", metavar="SPEED", help='an operating speed, for its margins: "540 rpm", "9 Hz", '
                                                              "or a speed ratio")
    arguments.add_argument("--least-width", default="0", metavar="WIDTH", help='of a band: "20 rpm", or in speed ratio '
                                                                               "(default: more than one speed)")
    arguments.add_argument("--aperiodic", action="store_true", help="aperiodic motions may be safe, too")
    arguments.add_argument("--json", metavar="BANDS.json", help="the bands as a file too")
    command_line.run(draw, arguments.parse_args(arguments_given))

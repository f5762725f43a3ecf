"""Waterfall: the spectrum of x over the speed ratio, with the places of the orders 1 to 3, n and 2n.

  rubatlas-plot waterfall ATLAS.h5 -o PICTURE.png [--damping_ratio 0.1 ...] [--max_frequency 4]

Orders become frequencies, order times speed ratio, in units of the rotor's natural frequency: a motion that is tied to
the rotation lies on oblique lines, one that is tied to the rotor stands upright. Marks on the borders, which leave the
data free, say where the lines of the orders 1, 2, 3 and of the blade passings (n blades: n and 2n) enter and leave.
"""
from typing import Any

import numpy as np

from rubatlas import command_line
from rubatlas import style
from rubatlas.atlas_file import AtlasFile


LEAST = 1e-9  # [mm] of a line that is no rounding


def by_frequency(speed, order, amplitude, edges):
    """Regrids each speed's line spectrum to frequency bins; a bin holds the largest amplitude that falls into it.

    Averages would sink a sharp line where bins are wider than the spacing of the orders. A bin without a line, where
    they are narrower, takes the line nearest to its middle. The mean position, of order 0, is no vibration. Returns
    (speeds, bins); NaN beyond the highest order, and where there is no motion.
    """
    order, amplitude = order[1:], amplitude[:, 1:]
    middle = 0.5 * (edges[1:] + edges[:-1])
    result = np.empty((len(speed), len(middle)))
    for row, (ratio, spectrum) in enumerate(zip(speed, amplitude)):
        frequency = order * ratio
        nearest = np.clip(np.rint(middle / frequency[0]) - 1, 0, len(order) - 1).astype(int)
        result[row] = np.where(middle <= frequency[-1], spectrum[nearest], np.nan)
        bins = np.digitize(frequency, edges) - 1
        inside = (bins >= 0) & (bins < len(middle))
        np.fmax.at(result[row], bins[inside], spectrum[inside])
    return result


def order_names(blades):
    """The marked orders with their labels: 1x, 2x, 3x, and those of the blade passings."""
    names = {order: f"{order}×" for order in (1, 2, 3)}
    for times, order in ((1, blades), (2, 2 * blades)):
        names[order] = f"{order}× = {'' if times == 1 else times}n"
    return dict(sorted(names.items()))


def named_orders(panel, top, blades):
    """The orders whose names do not cover each other; that of 1x and those of the blade passings come first."""
    low, high = panel.get_ylim()
    # In points, about: a colour bar and labels leave the panel four fifths of its place.
    letter, (width, height) = style.plt.rcParams["font.size"], 0.8 * 72.0 / panel.figure.dpi * panel.bbox.size
    taken: list[tuple[bool, float, float]] = []
    named = []
    for order, name in sorted(order_names(blades).items(), key=lambda item: item[0] not in (1, blades, 2 * blades)):
        above = order * high <= top
        middle = width * order * high / top if above else height * (top / order - low) / (high - low)
        half = letter * (0.35 * len(name) if above else 0.7)
        if all(side != above or abs(middle - other) >= half + room for side, other, room in taken):
            taken.append((above, middle, half))
            named.append(order)
    return named


def mark_orders(panel, top, blades):
    """Ticks outside the panel where the lines of the orders enter below and leave above or on the right, with as many
    of their names as fit."""
    low, high = panel.get_ylim()
    named = named_orders(panel, top, blades)
    for order, name in order_names(blades).items():
        blade_passing = order in (blades, 2 * blades)
        look: dict[str, Any] = dict(color=style.VERMILION if blade_passing else style.INK, clip_on=False, ms=7.0,
                                    mew=1.3, ls="none")
        if order * low < top:
            panel.plot([max(order * low, 0.0)], [low], marker=style.matplotlib.markers.TICKDOWN, **{**look, "ms": 5.0})
        above = order * high <= top
        place = (order * high, high) if above else (top, top / order)
        if place[1] < low:
            continue
        marker = style.matplotlib.markers.TICKUP if above else style.matplotlib.markers.TICKRIGHT
        panel.plot([place[0]], [place[1]], marker=marker, **look)
        if order not in named:
            continue
        panel.annotate(name, place, xytext=(0, 9) if above else (9, 0), textcoords="offset points", fontsize="medium",
                       ha="center" if above else "left", va="bottom" if above else "center", color=look["color"],
                       annotation_clip=False)


def into(panel, line, max_frequency=None):
    """The spectra of a line over frequency and speed ratio; returns the image, for a colour bar, and the legend of
    speeds without a motion."""
    atlas = line.atlas
    amplitude, speed, order = line.rows("spectrum"), atlas.axis("speed_ratio"), atlas.axis("order")
    units, factor = style.drawn(atlas.units("spectrum"))
    top = min(4.0, order[-1] * speed[-1]) if max_frequency is None else max_frequency
    edges = np.linspace(0.0, top, 501)
    shown = factor * by_frequency(speed, order, amplitude, edges)
    largest = np.nanmax(shown, initial=0.0)
    style.say_if_below(panel, shown, LEAST, f" {units}")
    if largest < LEAST:
        shown[:] = np.nan
    floor = 1e-6 * max(largest, LEAST)
    rows = style.edges_of(speed)
    image = style.image_into(panel, np.ma.masked_invalid(np.maximum(shown, floor)), (edges, rows), cmap="magma",
                             norm=style.matplotlib.colors.LogNorm(floor, max(largest, 10 * floor)))
    gaps = style.cells_into(panel, style.missing_cells(line.status()[:, np.newaxis]), (edges[[0, -1]], rows))
    panel.grid(False)
    panel.tick_params(axis="x", pad=7.0)  # the marks stand between
    mark_orders(panel, top, line.scene["blades"]["count"])
    panel.set_xlabel("Frequency / natural frequency [-]")
    panel.set_ylabel(style.label(atlas, "speed_ratio"))
    return image, gaps


def bar_label(atlas):
    return f"{atlas.long_name('spectrum')} [{style.drawn(atlas.units('spectrum'))[0]}]"


def draw(options):
    with AtlasFile(options.source) as atlas:
        line = atlas.line(**command_line.wanted(options, atlas.axes))
        figure, ((panel,),) = style.subplots(options, 1, 1, (8.5, 6.2))
        image, gaps = into(panel, line, options.max_frequency)
        style.rpm_axis(panel, atlas.sizes(), upwards=True)
        # The marks of the orders stand on the right.
        where = "bottom" if style.is_narrow(options) else "right"
        style.colour_bar(image, bar_label(atlas), ax=panel, pad=0.02, location=where)
        style.legend(panel, options, gaps, "below")
        style.title(figure, atlas, line.describe() + "\n\n")
        style.save(figure, options)


def main(arguments_given):
    arguments = command_line.parser(__doc__)
    arguments.add_argument("--max_frequency", type=command_line.positive(float),
                           help="right end, in natural frequencies (default: 4 or less)")
    command_line.run(draw, arguments.parse_args(arguments_given))

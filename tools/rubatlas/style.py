"""How all pictures look: one place for sizes, colours, hatchings, labels, titles and legends.

Colours of lines are those of Okabe and Ito, which people with any of the common colour deficiencies tell apart; maps
use `viridis`, which grows evenly in lightness, and classes of motion the palette of `palette.py`.
"""
import bisect
import math
import textwrap

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from matplotlib import cbook
from matplotlib.font_manager import FontProperties
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path
from matplotlib.text import Text
from matplotlib.textpath import text_to_path
from matplotlib.transforms import ScaledTranslation

from rubatlas import command_line, query
from rubatlas.atlas_file import DONE, SYMBOL
from rubatlas.palette import PALETTE

INK = "#1a1a2e"
QUIET = "#55556a"
BEHIND = "#b4b4c0"  # of hatchings behind curves
BLUE, ORANGE, GREEN, VERMILION, PURPLE, SKY, YELLOW, GREY = (
    "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9", "#F0E442", "#8c8c8c")
CYCLE = [BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, INK, GREY]
SEQUENTIAL = "viridis"

#: How figures and axes are made; of axes that a caller brings along only what is drawn into them is ours.
SETTINGS = {
    "figure.dpi": 100, "figure.constrained_layout.use": True, "figure.titlesize": 12, "figure.titleweight": "bold",
    "font.size": 9.5, "axes.titlesize": 9, "axes.labelsize": 9.5, "legend.fontsize": 8.5,
    "xtick.labelsize": 8.5, "ytick.labelsize": 8.5, "text.color": INK, "axes.labelcolor": INK,
    "axes.titlelocation": "left", "axes.titlecolor": QUIET,
    "axes.edgecolor": QUIET, "xtick.color": QUIET, "ytick.color": QUIET,
    "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.8,
    "axes.grid": True, "grid.color": "#e4e4ea", "grid.linewidth": 0.6, "axes.axisbelow": True,
    "svg.hashsalt": "rubatlas", "axes.prop_cycle": plt.cycler(color=CYCLE), "lines.linewidth": 1.1,
    "legend.frameon": False, "hatch.linewidth": 0.6,
}
#: What differs in a column of a journal: letters as small as can be read in print, and closer together.
COLUMN = {
    "figure.titlesize": 8.5, "font.size": 7.5, "axes.titlesize": 7, "axes.labelsize": 7.5, "legend.fontsize": 7,
    "xtick.labelsize": 7, "ytick.labelsize": 7, "axes.linewidth": 0.6, "lines.linewidth": 0.9,
    "legend.handlelength": 1.5, "legend.columnspacing": 1.2, "hatch.linewidth": 0.5,
}
NARROW = 5.0  # [inch] below this width panels stand below each other, and legends below panels
CREDIT = 6.0  # [pt] of the line below, the smallest letters of a picture

# Metres make poor tick labels here: lengths are drawn in millimetres, times in their own unit.
_DRAWN = {"m": ("mm", 1e3)}


# --- sizes ---

def is_narrow(options):
    return options.width is not None and options.width < NARROW


def figure(options, size, stacked=1):
    """A figure of a size [inch], or of the width that is asked for; then `stacked` parts side by side of it stand below
    each other if it is narrow."""
    narrow = is_narrow(options)
    plt.rcParams.update({**SETTINGS, **(COLUMN if narrow else {})})
    width, height = size
    if options.width is not None:
        # Letters shrink less than a picture does, so that it becomes taller than in proportion.
        width, height = options.width, height * (stacked if narrow else 1) * math.sqrt(options.width / width)
    return plt.figure(figsize=(width, height))


def subplots(options, rows, columns, size, heights=None, widths=None, sharex=False, sharey=False):
    """A figure and its panels, (rows, columns); those of one row may share y. In a narrow picture the panels of a row
    stand below each other."""
    made = figure(options, size, columns)
    heights = heights or [1] * rows
    if is_narrow(options):
        grid = made.subplots(rows * columns, 1, squeeze=False, sharex=sharex, height_ratios=np.repeat(heights, columns))
    else:
        grid = made.subplots(rows, columns, squeeze=False, sharex=sharex, height_ratios=heights, width_ratios=widths)
    grid = grid.reshape(rows, columns)
    for row in grid if sharey else []:
        for panel in row[1:]:
            panel.sharey(row[0])
            panel.tick_params(labelleft=is_narrow(options))
    return made, grid


def label_row(options, row, words):
    """What panels of one row show upwards, once, or at each of them where they stand below each other."""
    for panel in row if is_narrow(options) else row[:1]:
        panel.set_ylabel(words)


# --- words ---

def drawn(units):
    """Unit to draw a unit in, and the factor towards it."""
    return _DRAWN.get(units, (units, 1.0))


def label_of(name, units):
    """Label of an axis: a name as in a file, in words, with its symbol, and a unit."""
    words = " ".join([*name.split("_"), SYMBOL.get(name, "")]).strip()
    return f"{words[:1].upper()}{words[1:]} [{units}]"


def label(atlas, name):
    """Label of an axis of the grid: its name in the file, its symbol, and the unit it is drawn in."""
    return label_of(name, drawn(atlas.units(name))[0])


def width_of(text, size):
    """Of a line of letters of a size [pt]."""
    return text_to_path.get_text_width_height_descent(text, FontProperties(size=size), cbook.is_math_text(text))[0]


def rpm_axis(panel, sizes, upwards=False):
    """A second axis of the speed, in rpm, above or (`upwards`) on the left; none where the lines have several natural
    frequencies. `sizes`: of the atlas."""
    rpm = query.expressed(1.0, "rpm", sizes)
    if rpm is None:
        return
    both = {"functions": (lambda speed: speed * rpm, lambda speed: speed / rpm)}
    if upwards:
        # Beyond the words of the first one: [pt], in shares of a panel that has four fifths of the picture.
        ticks = panel.yaxis.get_major_formatter().format_ticks(panel.get_yticks())
        beyond = 40.0 + max(width_of(tick, plt.rcParams["ytick.labelsize"]) for tick in ticks)
        second = panel.secondary_yaxis(-beyond / (0.8 * 72.0 * panel.figure.get_figwidth()), **both)
        second.set_alignment("left")
        second.set_ylabel("Speed [rpm]")
    else:
        panel.secondary_xaxis("top", **both).set_xlabel("Speed [rpm]")


def headline(made, words):
    """The picture's title."""
    made.suptitle(words, x=0.01, ha="left").set_parse_math(False)  # a dollar sign is one


def title(made, atlas, what):
    """Two lines above (the scene's title; what is drawn), one below (reference, program and its version)."""
    headline(made, f"{atlas.scene.get('title') or atlas.path}")
    made.axes[0].set_title(what)
    made_by = f"rubatlas {atlas.attribute('software_version')} ({atlas.attribute('git_commit')[:10]})"
    made.supxlabel(" · ".join(part for part in (atlas.scene.get("reference", ""), made_by) if part),
                   fontsize=CREDIT, color=GREY, x=0.01, ha="left").set_parse_math(False)


def _wrap(text, whole, excess):
    """Breaks the lines of a text until `excess()` [pixel] is none; returns by how many lines it has grown. `whole`: its
    words as they were given; it may have been broken before, in another place."""
    before = text.get_text()
    lines = whole.split("\n")

    def too_long(letters):
        text.set_text("\n".join(textwrap.fill(line, letters) for line in lines))
        return excess() > 0.0

    if excess() > 0.0:
        least = 10
        shorter = bisect.bisect_left(range(least, max(map(len, lines))), True, key=too_long)
        too_long(least + max(0, shorter - 1))
    return text.get_text().count("\n") - before.count("\n")


def _place(made):
    """Places what is measured, as drawing it would."""
    made.get_layout_engine().execute(made)
    for axes in made.axes:
        axes.apply_aspect()


def wrap_words(made):
    """Breaks the lines of titles and labels that would be cut; the picture becomes taller by the lines of titles.
    Everything then stays in its place: to find it again takes longer than to draw it."""
    given: dict[Text, str] = {}

    def broken_lines(text, excess):
        return _wrap(text, given.setdefault(text, text.get_text()), excess)

    def break_titles(titles):
        broken = 0
        for text in titles:
            more = broken_lines(text, lambda text=text: text.get_window_extent().x1 - made.bbox.x1 + 4.0)
            made.set_figheight(made.get_figheight() + 1.2 * more * text.get_fontsize() / 72.0)
            broken += more
        return broken

    def break_labels():
        broken = 0
        for axes in made.axes:
            room = axes.bbox.height + axes.yaxis.label.get_fontsize()  # it may reach half into the space between panels
            broken += broken_lines(
                axes.yaxis.label, lambda axes=axes, room=room: axes.yaxis.label.get_window_extent().height - room)
        return broken

    break_titles(text for text in (made._suptitle, made._supxlabel) if text is not None)  # wherever panels stand
    _place(made)
    while break_titles(axes._left_title for axes in made.axes) + break_labels():
        _place(made)  # panels may have moved
    with plt.rc_context({"figure.constrained_layout.use": False}):
        made.set_layout_engine(None)  # with the engine "none" a figure is drawn twice to be saved


def columns_of(panel, handles):
    """Columns and lines of a legend that is as wide as the panel's part of the picture."""
    size = plt.rcParams["legend.fontsize"]
    texts = [line for handle in handles for line in handle.get_label().split("\n")]
    widest = max(width_of(text, size) for text in texts)
    place = panel.get_subplotspec()
    shares = np.array(place.get_gridspec().get_width_ratios(), dtype=float)
    width = 72.0 * panel.figure.get_figwidth() * shares[place.colspan.start:place.colspan.stop].sum() / shares.sum()
    # Beside the words: the labels of the axis on the left, the handle of each entry and the space to the next.
    columns = max(1, int((width - 5.0 * size) // (widest + 4.0 * size)))
    return min(columns, len(handles)), math.ceil(len(texts) / columns)


def legend(panel, options, handles=None, place="beside", **more):
    """The legend of a panel, which has its labels: beside it, below it, or at a place within; below it in any case if
    the picture is narrow, which becomes as much taller."""
    if handles is None:
        handles = panel.get_legend_handles_labels()[0]
    if not handles:
        return
    if place != "below" and not is_narrow(options):
        beside = {"loc": "upper left", "bbox_to_anchor": (1.0, 1.0)}
        panel.legend(handles=handles, **(beside if place == "beside" else {"loc": place}), **more)
        return
    made, (columns, lines) = panel.figure, columns_of(panel, handles)
    labels = 10.0 + plt.rcParams["axes.labelsize"] + plt.rcParams["xtick.labelsize"] if panel.get_xlabel() else 0.0
    moved = ScaledTranslation(0.0, -(labels + 4.0) / 72.0, made.dpi_scale_trans)  # from points
    panel.legend(handles=handles, loc="upper left", bbox_to_anchor=(0.0, 0.0), bbox_transform=panel.transAxes + moved,
                 borderaxespad=0.0, ncols=columns, **more)
    if is_narrow(options):
        made.set_figheight(made.get_figheight() + 1.5 * lines * plt.rcParams["legend.fontsize"] / 72.0)


# --- points without a motion, and classes ---

def edges_of(values):
    """The borders between the values of an axis, halfway between neighbours; one more than values."""
    values = np.asarray(values, dtype=float)
    if len(values) == 1:
        return np.array([values[0] - 0.01, values[0] + 0.01])
    middle = 0.5 * (values[1:] + values[:-1])
    return np.concatenate([[2.0 * values[0] - middle[0]], middle, [2.0 * values[-1] - middle[-1]]])


def limits_of(values):
    """From the first to the last value of an axis; around a single one."""
    return (edges_of(values) if len(values) == 1 else np.asarray(values))[[0, -1]]


FINE = 2000  # parts of an axis whose cells are not as wide as each other


def _parts(borders):
    """In which cell each part of an axis lies: as many parts as cells where these are as wide as each other."""
    widths = np.diff(borders)
    if np.allclose(widths, widths[0], rtol=1e-6, atol=0.0):
        return np.arange(len(widths))
    return np.searchsorted(borders, np.linspace(borders[0], borders[-1], 2 * FINE + 1)[1::2]) - 1


def image_into(panel, values, place, **look):
    """Draws the values of cells, row by row from below; `place`: the borders between them along x and along y."""
    (left, right), (bottom, top) = (borders[[0, -1]] for borders in place)
    return panel.imshow(values[np.ix_(*map(_parts, reversed(place)))], origin="lower", aspect="auto",
                        interpolation="nearest", extent=(left, right, bottom, top), **look)


def colour_bar(image, label, **place):
    """The colour bar of an image, beside the panel `ax` or in the panel `cax`; none if no cell has a value."""
    if image.get_array().count():
        image.figure.colorbar(image, label=label, **place)
    elif "cax" in place:
        place["cax"].set_axis_off()


def look(entry, density=4, ink=QUIET):
    """How a patch shows an entry of the palette."""
    return {"facecolor": entry["colour"], "edgecolor": ink, "hatch": density * entry.get("hatch", "")}


def mark_missing(axes, speed, status):
    """Shades the speeds at which there is no motion to show: left the model's validity, failed, or still pending.

    With the statuses of several lines, (lines, speeds), the shade is the fainter the fewer lines have no motion there.
    """
    status = np.atleast_2d(status)
    border = edges_of(speed)
    handles = []
    for entry in PALETTE["no_motion"]:
        share = (status == entry["status"]).mean(axis=0)
        steps = np.flatnonzero(np.diff(np.concatenate([[0.0], share, [0.0]])))
        for first, last in zip(steps[:-1], steps[1:]):
            if share[first] == 0.0:
                continue
            for one in np.atleast_1d(axes):
                one.axvspan(border[first], border[last], alpha=0.25 + 0.75 * share[first], lw=0, zorder=0,
                            **look(entry, 2, BEHIND))
        if share.any():
            some = "\n(fainter: some lines only)" if len(status) > 1 else ""
            handles.append(Patch(**look(entry, 2, BEHIND), lw=0.5, label=entry["name"] + some))
    return handles


def curve(panel, x, values, **look):
    """A thin line over x; what is known between two values that are not, which a line does not show, has a mark."""
    known = np.pad(np.isfinite(values), 1)
    alone = known[1:-1] & ~known[:-2] & ~known[2:]
    panel.plot(x, values, **{"lw": 0.9, "ms": 3.5, "marker": "." if alone.any() else None, "markevery": alone, **look})


def say_if_below(panel, values, least, units=""):
    """Says in a panel that shows nothing, since all values are below the least that can be seen, that they are."""
    known = np.asarray(values)[np.isfinite(values)]
    if known.size and known.max() < least:
        panel.annotate(f"below {least:g}{units} at all speeds", (0.5, 0.5), xycoords="axes fraction", ha="center",
                       va="center", color=QUIET)


def missing_cells(status):
    """Which points have no motion, and the entry of the palette that says why."""
    return [(entry, status == entry["status"]) for entry in PALETTE["no_motion"]]


def class_cells(classes, status, untouched=False):
    """Which points have which class of motion, or none; where no blade touches the ring the class is of no interest."""
    motion = [(entry, (classes >= entry["first"]) & (classes <= entry["last"]) & np.logical_not(untouched))
              for entry in PALETTE["classes"]]
    return [*motion, (PALETTE["no_contact"], (status == DONE) & untouched), *missing_cells(status)]


def _hatched(where, place, hatch):
    """A patch that hatches the cells of an image in which `where` is true."""
    steps = np.diff(np.pad(where.astype(np.int8), ((0, 0), (1, 1))), axis=1)
    (row, first), (_, end) = np.nonzero(steps == 1), np.nonzero(steps == -1)  # runs of cells of a row
    x, y = [place[0][column] for column in (first, end)], [place[1][height] for height in (row, row + 1)]
    corners = np.stack([x[0], y[0], x[1], y[0], x[1], y[1], x[0], y[1], x[0], y[0]], axis=-1).reshape(-1, 2)
    kinds = np.tile([Path.MOVETO, Path.LINETO, Path.LINETO, Path.LINETO, Path.CLOSEPOLY], len(row))
    return PathPatch(Path(corners, kinds), facecolor="none", edgecolor=QUIET, hatch=hatch, lw=0)


def cells_into(panel, cells, place):
    """Colours and hatches cells, placed as those of `image_into`, and leaves the others clear; returns the legend of
    those that occur."""
    image = np.zeros((*cells[0][1].shape, 4))
    for entry, where in cells:
        image[where] = matplotlib.colors.to_rgba(entry["colour"])
    image_into(panel, image, place)
    found = [(entry, where) for entry, where in cells if where.any()]
    for entry, where in found:
        if entry.get("hatch"):
            panel.add_patch(_hatched(where, place, look(entry)["hatch"]))
    return [Patch(**look(entry), lw=0.5, label=entry["name"]) for entry, _ in found]


def save(made, options):
    """Writes the picture that the options name."""
    wrap_words(made)
    command_line.write_picture(made, options)
    plt.close(made)

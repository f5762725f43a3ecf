"""How all pictures look: one place for colours, labels, titles and marks of points without a motion.

Colours are those of Okabe and Ito, which people with any of the common colour deficiencies tell apart; maps use
`viridis`, which grows evenly in lightness.
"""
import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Patch

from rubatlas import command_line
from rubatlas.atlas_file import INTEGRATOR_FAILED, LEFT_VALIDITY, PENDING, SYMBOL

INK = "#1a1a2e"
BLUE, ORANGE, GREEN, VERMILION, PURPLE, SKY, YELLOW, GREY = (
    "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9", "#F0E442", "#8c8c8c")
CYCLE = [BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, INK, GREY]
SEQUENTIAL = "viridis"

# Points without a motion: which statuses, in which colour, and what the legend says.
MISSING = [((LEFT_VALIDITY,), "#f3d9cd", "left the model's validity"),
           ((INTEGRATOR_FAILED,), "#d9b3d9", "integrator failed"),
           ((PENDING,), "#e6e6ec", "not computed yet")]

# Classes of motion as `rubatlas analyse` numbers them, and how a map shows them.
CLASSES = [
    ("period 1", "#c6e2f5", 1, 1),
    ("period 2", GREEN, 2, 2),
    ("period 3", YELLOW, 3, 3),
    ("period 4", ORANGE, 4, 4),
    ("period 5 to 16", PURPLE, 5, 16),
    ("unresolved", "#a0a0a0", 254, 254),
    ("aperiodic", INK, 255, 255),
]

#: How figures and axes are made; of axes that a caller brings along only what is drawn into them is ours.
SETTINGS = {
    "figure.dpi": 100, "figure.constrained_layout.use": True,
    "font.size": 9.5, "axes.titlesize": 10, "axes.labelsize": 9.5, "legend.fontsize": 8.5,
    "xtick.labelsize": 8.5, "ytick.labelsize": 8.5, "text.color": INK, "axes.labelcolor": INK,
    "axes.edgecolor": "#55556a", "xtick.color": "#55556a", "ytick.color": "#55556a",
    "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.8,
    "axes.grid": True, "grid.color": "#e4e4ea", "grid.linewidth": 0.6, "axes.axisbelow": True,
    "svg.hashsalt": "rubatlas", "axes.prop_cycle": plt.cycler(color=CYCLE), "lines.linewidth": 1.1,
    "legend.frameon": False,
}

# Metres make poor tick labels here: lengths are drawn in millimetres, times in their own unit.
_DRAWN = {"m": ("mm", 1e3)}


def drawn(units):
    """Unit to draw a unit in, and the factor towards it."""
    return _DRAWN.get(units, (units, 1.0))


def label(atlas, name):
    """Label of an axis of the grid: its name in the file, its symbol, and the unit it is drawn in."""
    words = " ".join([*name.split("_"), SYMBOL.get(name, "")]).strip()
    return f"{words[:1].upper()}{words[1:]} [{drawn(atlas.units(name))[0]}]"


def title(figure, atlas, what):
    """Two lines above (the scene's title; what is drawn), one below (reference, program and its version)."""
    figure.suptitle(f"{atlas.scene.get('title') or atlas.path}", fontsize=12, fontweight="bold", x=0.01, ha="left")
    figure.axes[0].set_title(what, loc="left", fontsize=9, color="#55556a")
    made_by = f"rubatlas {atlas.attribute('software_version')} ({atlas.attribute('git_commit')[:10]})"
    figure.supxlabel(" · ".join(part for part in (atlas.scene.get("reference", ""), made_by) if part),
                     fontsize=6.5, color=GREY, x=0.01, ha="left")


def edges_of(values):
    """The borders between the values of an axis, halfway between neighbours; one more than values."""
    values = np.asarray(values, dtype=float)
    if len(values) == 1:
        return np.array([values[0] - 0.01, values[0] + 0.01])
    middle = 0.5 * (values[1:] + values[:-1])
    return np.concatenate([[2.0 * values[0] - middle[0]], middle, [2.0 * values[-1] - middle[-1]]])


def mark_missing(axes, speed, status):
    """Shades the speeds at which there is no motion to show: left the model's validity, failed, or still pending.

    With the statuses of several lines, (lines, speeds), the shade is the fainter the fewer lines have no motion there.
    """
    status = np.atleast_2d(status)
    border = edges_of(speed)
    handles = []
    for codes, colour, text in MISSING:
        share = np.isin(status, codes).mean(axis=0)
        steps = np.flatnonzero(np.diff(np.concatenate([[0.0], share, [0.0]])))
        for first, last in zip(steps[:-1], steps[1:]):
            if share[first] == 0.0:
                continue
            for one in np.atleast_1d(axes):
                one.axvspan(border[first], border[last], color=colour, alpha=0.25 + 0.75 * share[first], lw=0, zorder=0)
        if share.any():
            handles.append(Patch(color=colour,
                                 label=text + ("\n(fainter: some lines only)" if len(status) > 1 else "")))
    return handles


def class_image(classes, status):
    """Colours (..., 3) of an array of classes of motion and their statuses, and the legend of those that occur."""
    image, handles = np.ones((*classes.shape, 3)), []
    entries = [(name, colour, (classes >= first) & (classes <= last)) for name, colour, first, last in CLASSES]
    entries += [(name, colour, np.isin(status, codes)) for codes, colour, name in MISSING]
    for name, colour, where in entries:
        if where.any():
            image[where] = matplotlib.colors.to_rgb(colour)
            handles.append(Patch(facecolor=colour, edgecolor="#55556a", lw=0.5, label=name))
    return image, handles


def missing_image(status):
    """Colours (..., 4) that cover an image where there is no motion, transparent elsewhere."""
    image = np.zeros((*status.shape, 4))
    for codes, colour, _ in MISSING:
        image[np.isin(status, codes)] = matplotlib.colors.to_rgba(colour)
    return image


def save(figure, options):
    """Writes the picture that the options name."""
    command_line.write_picture(figure, options)
    plt.close(figure)

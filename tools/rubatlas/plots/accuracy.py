"""Work-precision diagrams of a study of accuracy, and the table that says what accuracy costs.

  rubatlas-plot accuracy ACCURACY.h5 -o FOLDER [--map MAP.h5] [--reference orbits.json] [--page README.md]

Draws FOLDER/accuracy.png, the error of trajectories over time and work, and FOLDER/accuracy_map.png, the error of a
map, from what `rubatlas accuracy` has written; prints the table in Markdown. A second study, of more points, may serve
for the map; reference data are those of tests/reference. With --page the table replaces the one between the page's two
marks.
"""
import argparse
import pathlib

import numpy as np
from matplotlib.ticker import LogFormatter, NullLocator

from rubatlas import command_line
from rubatlas import style
from rubatlas.accuracy_file import AccuracyFile
from rubatlas.atlas_file import AtlasError, counted
from rubatlas.same_scene import require_same_machine

# A colour and a mark for each method, so that either distinguishes the lines.
LOOKS = {"hybrid": (style.BLUE, "o"), "collocation": (style.PURPLE, "*"), "hybrid_54": (style.SKY, "s"),
         "hybrid_32": (style.GREEN, "^"), "located": (style.ORANGE, "D"), "paper": (style.VERMILION, "v"),
         "fixed": (style.INK, "P")}
BEGIN, END = "<!-- accuracy: begin -->", "<!-- accuracy: end -->"
USUAL = ("collocation", "hybrid")  # the default method, and the one that stands in for it in a study without it
MOST_UNDECIDED = 0.01  # share of points: a map of which more is undecided at the tightest setting shows no limit
SMALLEST_DRAWN = 1e-15  # of the clearance: an error of zero has no logarithm


def usual_method(study):
    """The method whose tolerances are recommended."""
    return next(method for method in (*USUAL, *study.methods()) if method in study.methods())


def draw_lines(axes, study, cost, error, floor, width=1.4, **look):
    """One line per method (and per increment of force, where it has one); the marks are its settings."""
    for method in study.methods():
        colour, mark = LOOKS.get(method, (style.GREY, "x"))
        for number, settings in enumerate(study.ladders(method)):
            axes.plot(cost[settings], np.maximum(error[settings], floor), color=colour, marker=mark, markersize=4.5,
                      lw=2.0 * width if method == usual_method(study) else width, label=method if number == 0 else None,
                      **look)


def plain_numbers(axis):
    """Numbers without powers on a logarithmic axis; where it has not a decade, at the ticks within it too."""
    axis.set_major_formatter("{x:g}")
    axis.set_minor_formatter(LogFormatter())


def as_output(options, name):
    """The options of one picture in the folder."""
    return argparse.Namespace(**{**vars(options), "output": options.output / name})


def draw_trajectories(study, options):
    """Error against CPU time and right-hand sides: above of predictable points, below within the others' horizon."""
    known = "predictable to the end:\nlargest error / clearance"
    groups = [(study.predictable(), known),
              (~study.predictable(), "not predictable, within the horizon:\nlargest error / clearance")]
    groups = [(points, words) for points, words in groups if points.any()]
    figure, panels = style.subplots(options, len(groups), 2, (11.5, 1.3 + 3.1 * len(groups)), sharey=True)
    for (points, words), row in zip(groups, panels):
        error = np.where(study.complete(points), study.worst_error(points), np.nan)
        costs = [1e3 * study.mean("cpu_time_min", points), study.mean("right_hand_sides", points)]
        for axes, cost in zip(row, costs):
            draw_lines(axes, study, cost, error, SMALLEST_DRAWN)
            if options.reference and words is known:
                axes.plot(cost[1:], study.error_against(options.reference, points)[1:], ls="none", marker="x",
                          markersize=5.0,
                          color=style.INK, zorder=5)
            axes.set_xscale("log")
            axes.set_yscale("log")
        style.label_row(options, row, f"{counted(np.count_nonzero(points), 'points')} {words}")
        plain_numbers(row[0].xaxis)
    panels[-1][0].set_xlabel("CPU time of a point [ms]")
    panels[-1][1].set_xlabel("Right-hand sides of a point [-]")
    handles = panels[0][0].get_legend_handles_labels()[0]
    if options.reference:
        handles.append(style.plt.Line2D([], [], ls="none", marker="x", color=style.INK,
                                        label="against the\nreference data"))
    style.legend(panels[-1 if style.is_narrow(options) else 0][1], options, handles)
    style.title(figure, study, f"Work and precision: {study.describe()}")
    style.save(figure, as_output(options, "accuracy.png"))


def draw_map(study, options):
    """Share of points that a map shows wrongly, against CPU time and right-hand sides."""
    count = study.point_count()
    zero = 0.4 / count  # where "none" is drawn: below the share of one point
    everywhere = np.ones(study.point_count(), dtype=bool)
    costs = [1e3 * study.mean("cpu_time_min", everywhere), study.mean("right_hand_sides", everywhere)]
    figure, (panels,) = style.subplots(options, 1, 2, (11.5, 4.4), sharey=True)
    for axes, cost in zip(panels, costs):
        draw_lines(axes, study, cost, study["map_error_beyond_chaos"], zero)
        method = usual_method(study)
        ladder = study.of(method)
        axes.plot(cost[ladder], np.maximum(study["map_error"][ladder], zero), color=style.GREY, ls=(0, (4, 3)),
                  label=f"{method}, with the maxima of\nunpredictable points")
        axes.axhline(1.0 / count, color=style.GREY, lw=0.7)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_ylim(0.75 * zero, 1.3)
    ticks = [tick for tick in (1.0, 0.1, 0.01, 0.001) if tick > 1.0 / count]
    panels[0].set_yticks([*ticks, 1.0 / count, zero], [*(f"{100 * tick:g} %" for tick in ticks), "1 point", "none"])
    panels[0].yaxis.set_minor_locator(NullLocator())
    style.label_row(options, panels, "Share of points with another class,\nregion or maximum displacement")
    plain_numbers(panels[0].xaxis)
    panels[0].set_xlabel("CPU time of a point [ms]")
    panels[1].set_xlabel("Right-hand sides of a point [-]")
    style.legend(panels[1], options)
    style.title(figure, study, f"Error of the map: {study.describe()}")
    style.save(figure, as_output(options, "accuracy_map.png"))


def trusted(study):
    """The loosest setting of the usual method from which on the map does not change; None if it always changes.

    What still differs at the tightest setting is not an error of the looser ones: a point at the edge of two classes,
    say.
    """
    ladder = study.of(usual_method(study))
    share = study["map_error_beyond_chaos"][ladder]
    if not len(ladder) or share[-1] > MOST_UNDECIDED:
        return None
    return ladder[int(np.max(np.flatnonzero(share > share[-1]), initial=-1)) + 1]


def sentence(maps):
    """The recommended tolerance, its cost, and the cost of a ten times smaller one."""
    setting = trusted(maps)
    if setting is None:
        return "The map changes at every tolerance that was tried."
    everywhere = np.ones(maps.point_count(), dtype=bool)
    time = 1e3 * maps.mean("cpu_time_min", everywhere)
    chosen = maps["tolerance"][setting]
    text = f"For a map you can trust, use tolerance {chosen:.0e}; it costs {time[setting]:.1f} ms a point"
    tighter = [other for other in maps.of(usual_method(maps))
               if np.isclose(maps["tolerance"][other], chosen / 10.0, rtol=1e-6, atol=0.0)]
    if tighter:
        text += f"; ten times more accurate costs {round(100.0 * (time[tighter[0]] / time[setting] - 1.0))} % more"
    return text + "."


def percent(share):
    return "0" if share == 0.0 else f"{100.0 * share:.1f} %"


def ladder_table(study, maps, reference):
    """Cost and errors of the usual method, tolerance by tolerance."""
    method = usual_method(maps)
    points, everywhere = study.predictable(), np.ones(maps.point_count(), dtype=bool)
    error = study.worst_error(points)
    against = study.error_against(reference, points) if reference else None
    time, calls = 1e3 * maps.mean("cpu_time_min", everywhere), maps.mean("right_hand_sides", everywhere)
    touchdowns = maps.mean("touchdowns", everywhere)
    head = ["tolerance", "trajectory error / δc", *(["against the reference data"] if reference else []), "map error",
            "and maxima of unpredictable points", "ms a point of the map", "right-hand sides per touch-down"]
    rows = []
    for setting in maps.of(method):
        tolerance = maps["tolerance"][setting]
        same = [i for i in study.of(method) if np.isclose(study["tolerance"][i], tolerance, rtol=1e-6, atol=0.0)]
        rows.append([f"{tolerance:.0e}", *([f"{error[same[0]]:.1e}"] if same else ["-"]),
                     *([f"{against[same[0]]:.1e}" if same else "-"] if against is not None else []),
                     percent(maps["map_error_beyond_chaos"][setting]), percent(maps["map_error"][setting]),
                     f"{time[setting]:.1f}", f"{calls[setting] / max(touchdowns[setting], 1e-300):.0f}"])
    return markdown(head, rows)


def method_table(study, goal):
    """Cost of each method for the same error on the points that are predictable to the end."""
    points = study.predictable()
    error, time = study.worst_error(points), 1e3 * study.mean("cpu_time_min", points)
    calls = study.mean("right_hand_sides", points)
    best = {}
    for method in study.methods():
        reached = [setting for setting in study.of(method) if error[setting] <= goal]
        best[method] = min(reached, key=lambda setting: time[setting]) if reached else None
    usual = usual_method(study)
    rows = []
    for method, setting in best.items():
        if setting is None:
            nearest = min(study.of(method), key=lambda other: np.nan_to_num(error[other], nan=np.inf))
            rows.append([f"`{method}`", study.knobs(nearest), f"{error[nearest]:.1e}", f"{time[nearest]:.3g}",
                         f"{calls[nearest]:.2g}", "not reached"])
            continue
        times = f"{time[setting] / time[best[usual]]:.3g} ×" if best[usual] is not None else "-"
        rows.append([f"`{method}`", study.knobs(setting), f"{error[setting]:.1e}", f"{time[setting]:.3g}",
                     f"{calls[setting]:.2g}", times])
    return markdown(["method", "knobs", "trajectory error / δc", "ms a predictable point", "right-hand sides",
                     f"time of `{usual}`"], rows)


def markdown(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def report(study, maps, options):
    """The text of the README."""
    return "\n\n".join([sentence(maps), ladder_table(study, maps, options.reference),
                        "On the points that are predictable to the end, the cheapest setting of each method with an "
                        f"error of at most {options.goal:.0e} of\nthe clearance, or its best one:",
                        method_table(study, options.goal)])


def put_into_page(path, text):
    """Replaces the text between the two marks of a page."""
    page = path.read_text()
    if BEGIN not in page or END not in page:
        raise AtlasError(f"{path}: no lines {BEGIN} and {END} to put the table between")
    path.write_text(page[:page.index(BEGIN) + len(BEGIN)] + "\n" + text + "\n" + page[page.index(END):])


def draw(options):
    study = AccuracyFile(options.source)
    maps = AccuracyFile(options.map) if options.map else study
    require_same_machine(study.path, study.scene, maps.path, maps.scene)
    options.output.mkdir(parents=True, exist_ok=True)
    if options.reference:
        study.require_reference(options.reference)
    draw_trajectories(study, options)
    draw_map(maps, options)
    text = report(study, maps, options)
    if options.page:
        put_into_page(options.page, text)
    print(text)


def parser():
    result = command_line.Arguments(__doc__)
    result.add_argument("source", metavar="ACCURACY.h5")
    result.add_argument("-o", "--output", required=True, type=pathlib.Path, metavar="FOLDER")
    result.add_argument("--map", metavar="MAP.h5", help="a study of more points, for the error of the map")
    result.add_argument("--reference", metavar="ORBITS.json", help="compare sections with these data too")
    result.add_argument("--page", type=pathlib.Path, metavar="README.md", help="put the table into this page")
    result.add_argument("--goal", type=command_line.positive(float), default=1e-6,
                        help="error at which methods are compared (default: 1e-6)")
    command_line.add_size(result)
    return result


def main(arguments_given):
    chosen = parser().parse_args(arguments_given)
    command_line.end_on_mistakes(lambda: draw(chosen))

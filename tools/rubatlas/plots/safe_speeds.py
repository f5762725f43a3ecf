"""Speeds at which a rotor keeps given limits for all values of the other quantities, as bands.

  rubatlas-plot safe_speeds ATLAS.h5 -o PICTURE.png --keep "max_displacement<=0.012" --keep "max_root_strain<=0.002"
                       [--keep "nearest_miss>=1e-4"] [--maps MAPS.h5 --keep "margin>=0.01" --keep "class<=1"]
                       [--operate 0.64] [--json BANDS.json] [--damping_ratio 0.1 ...]

A limit names a dataset of the atlas with one number per point, in its own unit, or one of the maps that `rubatlas
analyse` writes: `class`, or `margin`, the distance in speed ratio to the nearest change of motion. A speed is safe if
every line of the atlas, or every one at the values named by options, keeps every limit there. What does not occur keeps
its limit: a miss where no tip passes the ring, a margin where the motion never changes. A point that is not done keeps
none.

A band reaches from its first to its last safe speed of the grid; nothing is said of the step beyond. Its separation
margin is the percentage by which the speed may be off on either side at its middle, and that of --operate the
percentage to the nearest speed that is not safe. An end is open where the grid ends, or where points are not done.
Where a motion leaves the model it is not.
"""
import contextlib
import json
import operator
import os
import pathlib
import re
import tempfile

import numpy as np

from rubatlas import command_line
from rubatlas import style
from rubatlas.atlas_file import DONE, LEFT_VALIDITY, AtlasError, AtlasFile
from rubatlas.same_scene import require_same

KEEPS = {"<=": operator.le, ">=": operator.ge}
# Datasets in which NaN means that there is nothing to keep away from.
MAY_NOT_OCCUR = ("nearest_miss", "lightest_touch", "margin")
OF_MAPS = {"margin": "margins/speed_ratio", "class": "class"}
# Why a speed is in no band, besides the limits. What is not done or not selected is not known to be dangerous, so that
# a band is open there.
LEFT, NOT_DONE, NOT_SELECTED = "the motion leaves the model", "not done", "not selected"


class Limit:
    """One of the limits: `name` of a dataset, the comparison, the bound in the dataset's unit."""

    def __init__(self, text):
        parts = re.fullmatch(r"\s*(\w+)\s*(<=|>=)\s*(\S+)\s*", text)
        try:
            self.name, self.sign = parts[1], parts[2]  # type: ignore[index]
            self.bound = float(parts[3])  # type: ignore[index]
        except (TypeError, ValueError):
            raise AtlasError(f"limit {text}: not of the form NAME<=NUMBER or NAME>=NUMBER") from None
        self.text = f"{self.name} {'≤' if self.sign == '<=' else '≥'} {self.bound:g}"

    def keeps(self, values):
        kept = KEEPS[self.sign](values, self.bound)
        return kept | np.isnan(values) if self.name in MAY_NOT_OCCUR else kept

    def worst(self, values):
        """The value of the line that is nearest to breaking the limit, speed by speed."""
        with np.errstate(all="ignore"):
            return np.fmax.reduce(values, axis=0) if self.sign == "<=" else np.fmin.reduce(values, axis=0)


def lines_of(atlas, wanted):
    """Places of all lines at the values that the user has named."""
    unknown = set(wanted) - set(atlas.axes[:-1])
    if unknown:
        raise AtlasError(f"{atlas.path}: no axis {', '.join(sorted(unknown))}; "
                         f"a line is picked by {', '.join(atlas.axes[:-1])}")
    choices = [[atlas.index(name, wanted[name])] if name in wanted else range(len(atlas.axis(name)))
               for name in atlas.axes[:-1]]
    return np.ix_(*choices, range(len(atlas.axis("speed_ratio"))))


def rows(atlas, maps, limit, chosen):
    """The values of a limit's dataset on the chosen lines, (lines, speeds), NaN where the point is not done; and their
    unit."""
    if limit.name in OF_MAPS:
        if maps is None:
            raise AtlasError(f"limit {limit.text}: this is in the maps of the atlas, "
                             "which `rubatlas analyse` makes and --maps (maps=) names")
        if OF_MAPS[limit.name] not in maps:
            raise AtlasError(f"limit {limit.text}: {maps.path} has no /{OF_MAPS[limit.name]}")
        source, name = maps, OF_MAPS[limit.name]
    else:
        source, name = atlas, limit.name
    dataset = source.dataset(name)
    if dataset.ndim != len(atlas.axes):
        raise AtlasError(f"limit {limit.text}: /{name} has more than one number per point")
    status = atlas.dataset("status")[...][chosen]
    values = np.where(status == DONE, dataset[...][chosen].astype(float), np.nan)
    if limit.name == "class":
        values[values == 0] = np.nan  # no class was found, which keeps no limit
    speeds = values.shape[-1]
    return values.reshape(-1, speeds), status.reshape(-1, speeds), source.units(name)


def bands_of(safe):
    """First and last place of each run of safe speeds."""
    steps = np.flatnonzero(np.diff(np.concatenate([[0], safe.astype(int), [0]])))
    return list(zip(steps[::2], steps[1::2] - 1))


def margin_percent(low, high):
    """By how many percent the speed in the middle may be off on either side."""
    return 100.0 * (high - low) / (high + low)


class Judgement:
    """Which limits are kept where.

    `chosen`: the lines to judge, as an index of the grid with all speeds. `selected`: the points of the grid to judge;
    a speed at which a line is not selected is in no band.
    """

    def __init__(self, atlas, maps, limits, chosen, selected=None):
        self.speed = atlas.axis("speed_ratio")
        self.values, self.units, broken = [], [], []
        for limit in limits:
            values, status, units = rows(atlas, maps, limit, chosen)
            self.values.append(values)
            self.units.append(units)
            broken.append(((status == DONE) & ~limit.keeps(values)).any(axis=0))
        self.status = status
        self.left = (status == LEFT_VALIDITY).any(axis=0)
        self.undone = ((status != DONE) & (status != LEFT_VALIDITY)).any(axis=0)
        self.broken = np.array(broken)
        self.unselected = np.zeros(len(self.speed), dtype=bool)
        if selected is not None:
            self.unselected = ~selected[chosen].reshape(status.shape).all(axis=0)
        self.safe = ~self.broken.any(axis=0) & ~self.left & ~self.undone & ~self.unselected
        self.limits = limits

    def reasons(self, place):
        """What is not kept at a speed."""
        if self.unselected[place]:
            return [NOT_SELECTED]
        reasons = [limit.text for limit, broken in zip(self.limits, self.broken[:, place]) if broken]
        others = [LEFT] if self.left[place] else []
        return reasons + others + ([NOT_DONE] if self.undone[place] else [])

    def beyond(self, place):
        """What ends a band at its neighbour `place`; nothing beyond the grid."""
        if not 0 <= place < len(self.speed):
            return {"open": True, "broken": []}
        reasons = self.reasons(place)
        return {"speed_ratio": float(self.speed[place]), "open": reasons in ([NOT_DONE], [NOT_SELECTED]),
                "broken": reasons}

    def bands(self):
        found = []
        for first, last in bands_of(self.safe):
            low, high = float(self.speed[first]), float(self.speed[last])
            found.append({"from": low, "to": high, "points": int(last - first + 1), "middle": 0.5 * (low + high),
                          "margin_percent": margin_percent(low, high),
                          "below": self.beyond(first - 1), "above": self.beyond(last + 1)})
        return found

    def at(self, speed_ratio):
        """How an operating speed stands: in which band, and how far in percent the nearest unsafe speeds are."""
        if not self.speed[0] <= speed_ratio <= self.speed[-1]:
            raise AtlasError(f"operating speed {speed_ratio:g}: outside the atlas, which has speed ratios from "
                             f"{self.speed[0]:g} to {self.speed[-1]:g}")
        band = next((band for band in self.bands() if band["from"] <= speed_ratio <= band["to"]), None)
        if band is None:
            place = int(np.argmin(abs(self.speed - speed_ratio)))
            return {"speed_ratio": speed_ratio, "safe": False, "broken": self.reasons(place)}
        return {"speed_ratio": speed_ratio, "safe": True,
                "below_percent": 100.0 * (speed_ratio - band["from"]) / speed_ratio,
                "above_percent": 100.0 * (band["to"] - speed_ratio) / speed_ratio,
                "open_below": band["below"]["open"], "open_above": band["above"]["open"]}


def end_text(side, end):
    if not end["broken"]:
        return f"{side}: the grid ends"
    reasons = [reason if reason in (LEFT, NOT_DONE, NOT_SELECTED) else f"not {reason}" for reason in end["broken"]]
    return f"{side}: {' and '.join(reasons)} at {end['speed_ratio']:g}"


def sentences(result):
    """The bands, for people."""
    for band in result["bands"]:
        yield (f"Ω {band['from']:g} to {band['to']:g}: ±{band['margin_percent']:.1f} % about {band['middle']:.4g}; "
               f"{end_text('below', band['below'])}; {end_text('above', band['above'])}")
    if not result["bands"]:
        yield "no speed of the atlas keeps these limits"
    if "operate" in result:
        at = result["operate"]
        if not at["safe"]:
            yield f"Ω {at['speed_ratio']:g} is not safe: {', '.join(at['broken']) or 'it lies between two bands'}"
        else:
            below, above = ("" if not at[f"open_{side}"] else " or more" for side in ("below", "above"))
            yield (f"Ω {at['speed_ratio']:g}: {at['below_percent']:.1f} %{below} to the band's end below, "
                   f"{at['above_percent']:.1f} %{above} to that above")


def write_json(path, result):
    """Complete or not at all."""
    path = pathlib.Path(path)
    with tempfile.NamedTemporaryFile("w", dir=path.parent, prefix=f".{path.name}.", delete=False,
                                     encoding="utf-8") as file:
        json.dump(result, file, indent=2, ensure_ascii=False)
        file.write("\n")
    os.chmod(file.name, 0o644)
    os.replace(file.name, path)


def require_json_place(options):
    """A JSON file is new, or replaces bands."""
    if options.json is None:
        return
    path = pathlib.Path(options.json)
    if path.suffix != ".json" or not path.parent.is_dir():
        raise AtlasError(f"--json {path}: a file that ends in .json, in a folder that is there")
    if path.exists():
        try:
            replaceable = "bands" in json.loads(path.read_text(encoding="utf-8"))
        except (OSError, ValueError, TypeError):
            replaceable = False
        if not replaceable:
            raise AtlasError(f"--json {path}: this file is there and holds no bands; bands replace bands only")


def draw_picture(atlas, judgement, options, fixed):
    limits = judgement.limits
    figure, panels = style.plt.subplots(len(limits), 1, figsize=(9.5, 1.0 + 1.8 * len(limits)), sharex=True,
                                        squeeze=False)
    border = style.edges_of(judgement.speed)
    for panel, limit, values, units in zip(panels[:, 0], limits, judgement.values, judgement.units):
        unit, factor = style.drawn(units)
        for first, last in bands_of(judgement.safe):
            panel.axvspan(border[first], border[last + 1], color=style.GREEN, alpha=0.18, lw=0, zorder=0)
        gaps = style.mark_missing(panel, judgement.speed, judgement.status)
        panel.plot(judgement.speed, factor * limit.worst(values), color=style.BLUE, lw=0.9)
        panel.axhline(factor * limit.bound, color=style.VERMILION, lw=0.9, ls=(0, (4, 3)))
        panel.set_ylabel(f"{limit.name.replace('_', ' ')} [{unit}]")
        positive = values[np.isfinite(values) & (values > 0)]
        if (limit.sign == ">=" or limit.name == "class") and len(positive) and limit.bound > 0:
            panel.set_yscale("log")  # what must not become small is looked at by its decades, and 255 is aperiodic
        if options.operate is not None:
            panel.axvline(options.operate, color=style.INK, lw=0.9)
    handles = [style.Patch(color=style.GREEN, alpha=0.18, label="every limit is kept"),
               style.plt.Line2D([], [], color=style.BLUE, lw=0.9, label="the line nearest to the limit"),
               style.plt.Line2D([], [], color=style.VERMILION, lw=0.9, ls=(0, (4, 3)), label="limit")]
    panels[0, 0].legend(handles=[*handles, *gaps], loc="upper left", bbox_to_anchor=(1.0, 1.0))
    panels[-1, 0].set_xlabel(style.label(atlas, "speed_ratio"))
    panels[-1, 0].set_xlim(judgement.speed[0], judgement.speed[-1])
    style.title(figure, atlas, f"Safe for {fixed}")
    style.save(figure, options)


def draw(options):
    require_json_place(options)
    limits = [Limit(text) for text in options.keep]
    with contextlib.ExitStack() as files:
        atlas = files.enter_context(AtlasFile(options.source))
        maps_path = command_line.maps_of(options)
        maps = files.enter_context(AtlasFile(maps_path)) if maps_path else None
        if maps:
            require_same(atlas.path, atlas.scene, maps.path, maps.scene)
        wanted = command_line.wanted(options, atlas.axes)
        judgement = Judgement(atlas, maps, limits, lines_of(atlas, wanted))
        held = [f"{name.replace('_', ' ')} {value:g}" if name != "direction" else f"swept {value}"
                for name, value in wanted.items()]
        every = [name.replace("_", " ") for name in atlas.swept_axes() if name not in wanted]
        fixed = ", ".join([*held, *([f"every {' and '.join(every)}"] if every else [])]) or "the one line of the atlas"
        result = {"atlas": os.path.basename(atlas.path), "limits": [limit.text for limit in limits],
                  "lines": len(judgement.status),
                  "for": fixed, "bands": judgement.bands()}
        if options.operate is not None:
            result["operate"] = judgement.at(options.operate)
        draw_picture(atlas, judgement, options, fixed)
        if options.json:
            write_json(options.json, result)
        print(*sentences(result), sep="\n")


def main(arguments_given):
    arguments = command_line.parser(__doc__)
    arguments.add_argument("--keep", action="append", required=True, metavar="LIMIT",
                           help='a limit such as "max_displacement<=0.012"; may be repeated')
    command_line.add_maps(arguments, "for limits on margin and class")
    arguments.add_argument("--operate", type=float, metavar="SPEED_RATIO", help="an operating speed, for its margins")
    arguments.add_argument("--json", metavar="BANDS.json", help="the bands as a file too")
    command_line.run(draw, arguments.parse_args(arguments_given))

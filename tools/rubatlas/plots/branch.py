"""A branch of periodic orbits: size of the orbit over the quantity that varies, stable or not, with its bifurcations.

  rubatlas-plot branch BRANCH.h5 -o PICTURE.png

BRANCH.h5 is what `rubatlas branch` writes. Above, the section's distance from the centre; below, the largest
multiplier. Stable orbits are drawn as full lines, unstable ones dotted. A curve of bifurcations is drawn in the plane
of its two quantities.
"""
import json

import numpy as np

from rubatlas import command_line
from rubatlas import style
from rubatlas.atlas_file import AtlasError, UnreadableFile, counted, printable, reading, sizes_of, swept_pointers, \
    text, values_of

# Marks of the kinds of events, as the file numbers them.
MARKS = {1: ("fold", "s", style.GREEN), 2: ("period doubling", "D", style.VERMILION),
         3: ("Neimark-Sacker", "^", style.PURPLE), 4: ("grazing", "o", style.ORANGE), 5: ("lost", "x", style.GREY)}


class BranchFile:
    """A branch, read whole, with what `style` asks of an atlas."""

    def __init__(self, path):
        self.path = str(path)
        with reading(path, "a branch that `rubatlas branch` has written", "branch") as file:
            if text(file.attrs.get("kind", "")) != "branch":
                raise AtlasError(f"{path}: this is no branch; `rubatlas branch` writes one")
            self.attributes = dict(file.attrs)
            self.scene = json.loads(file["scene_resolved"][()])
            names: list[str] = []
            file.visit(names.append)
            self.data = {name: file[name][()] for name in names if hasattr(file[name], "dtype")}
            if "passings" in self.data:  # older files have none
                passings, period = self.data["passings"], self.data["period"]
                if passings.dtype.kind != "i" or passings.shape != period.shape or (passings < 1).any():
                    raise UnreadableFile(f"{path}: /passings are no numbers of blade passings, one of each orbit; the "
                                         "file is damaged")
            self.units = {which: text(file[name].attrs["units"]) for which, name in
                          (("along", "parameter"), ("in", "second_parameter")) if name in file}

    def __contains__(self, name):
        return name in self.data

    def __getitem__(self, name):
        return self.data[name]

    def attribute(self, name):
        return printable(self.attributes.get(name, ""))

    def name_of(self, which):
        """The quantity that the attribute `along` or `in` points to."""
        return self.attribute(which).rsplit("/", 1)[-1].replace("_", " ")

    def label(self, which):
        """The same as the label of an axis."""
        units = self.units[which]
        return style.label_of(self.name_of(which).replace(" ", "_"), "-" if units == "1" else units)


def colour_of(which):
    """Of the branch with this number."""
    return style.CYCLE[int(which) % len(style.CYCLE)]


WIDTHS = {"-": 1.8, ":": 1.1}  # of lines of stable and unstable orbits
JUMP = 100.0  # of a value, between two orbits that are neighbours


def size_of(orbits):
    """Distance of the section from the centre [mm]."""
    return 1e3 * np.hypot(*np.moveaxis(np.asarray(orbits)[:, :2], -1, 0))


def draw_curve(branch, options):
    _, ((panel,),) = style.subplots(options, 1, 1, (9.0, 6.0))
    panel.plot(branch["second_parameter"], branch["parameter"], color=style.BLUE)
    panel.set_xlabel(branch.label("in"))
    panel.set_ylabel(branch.label("along"))
    return panel.figure, f"curve of {branch.attribute('curve').replace('_', ' ')}"


def stretches(stable, parameter, values, events):
    """(stable or not, parameter, value) of each stretch of one stability; neighbours meet at the bifurcation between
    them, of which `events` has the parameters and the values, unless the value jumps there, as multipliers do at a
    grazing."""
    begins = [0, *(1 + np.flatnonzero(stable[1:] != stable[:-1])), len(stable)]
    joints = []
    for after in begins[1:-1]:
        low, high = sorted(parameter[after - 1:after + 1])
        before, behind = values[after - 1:after + 1]
        meeting = [(at, value) for at, value in zip(*events) if low <= at <= high]
        at, value = [*meeting, (0.5 * (low + high), 0.5 * (before + behind))][0]
        met = max(before, behind) < JUMP * min(before, behind)
        joints.append(([at], [value]) if met else ([], []))
    for number, (first, end) in enumerate(zip(begins[:-1], begins[1:])):
        parts = [*joints[max(0, number - 1):number], (parameter[first:end], values[first:end]),
                 *joints[number:number + 1]]
        yield stable[first], *(np.concatenate(part) for part in zip(*parts))


def largest_of(multipliers):
    """Modulus of the first of them."""
    return np.hypot(*np.moveaxis(multipliers[:, 0], -1, 0))


def branch_handles(branch):
    """Entries of the legend: a colour for each branch where there are several, full and dotted lines."""
    number, period = branch["branch"], branch["period"]
    several = np.unique(number) if len(np.unique(number)) > 1 else []
    passings = branch["passings"] if "passings" in branch else period * branch.scene["blades"]["count"]
    tells_more = (passings < period * branch.scene["blades"]["count"]).any()  # than the period in revolutions
    looks = []
    for which in several:
        first = np.flatnonzero(number == which)[0]
        over = f", {counted(passings[first], 'blade passings')}" if tells_more else ""
        looks.append(("-", colour_of(which), f"branch of period {period[first]}{over}"))
    there = np.unique(branch["stability"] == 1)
    ink = style.INK if len(several) else colour_of(number[0])
    looks += [(kind, ink, word) for kind, word, stable in (("-", "stable", True), (":", "unstable", False))
              if stable in there]
    return [style.plt.Line2D([], [], ls=kind, color=colour, lw=WIDTHS[kind], label=word)
            for kind, colour, word in looks]


def draw_branch(branch, options):
    figure, ((upper,), (lower,)) = style.subplots(options, 2, 1, (9.0, 6.0), [3, 2], sharex=True)
    number, stable = branch["branch"], branch["stability"] == 1
    parameter = branch["parameter"]
    for which in np.unique(number):
        here = number == which
        colour = colour_of(which)
        for panel, values_of_orbits, name in ((upper, size_of, "section"), (lower, largest_of, "multipliers")):
            events = np.empty((2, 0))
            if "events/kind" in branch:
                of_it = branch["events/branch"] == which
                events = np.array([branch["events/parameter"][of_it],
                                   values_of_orbits(branch[f"events/{name}"][of_it])])
            values = values_of_orbits(branch[name][here])
            for is_stable, along, value in stretches(stable[here], parameter[here], values, events):
                kind = "-" if is_stable else ":"
                panel.plot(along, value, kind, color=colour, lw=WIDTHS[kind])
    if "events/kind" in branch:
        kinds, where = branch["events/kind"], branch["events/parameter"]
        sizes = size_of(branch["events/section"])
        for kind in np.unique(kinds):
            label, mark, colour = MARKS[int(kind)]
            # A grazing often follows on a Neimark-Sacker bifurcation so closely that both marks are in one place.
            look = {"ms": 9, "mfc": "none", "mew": 1.4} if kind == 3 else {"ms": 5}
            upper.plot(where[kinds == kind], sizes[kinds == kind], mark, color=colour, label=label, zorder=3, **look)
    lower.axhline(1.0, color=style.INK, lw=0.8)
    lower.set_yscale("log")
    upper.set_ylabel("Section's distance [mm]")
    lower.set_ylabel("Largest multiplier")
    lower.set_xlabel(branch.label("along"))
    if branch.name_of("along") == "speed ratio":
        style.rpm_axis(upper, sizes_of(branch.scene))
    style.legend(lower if style.is_narrow(options) else upper, options,
                 [*branch_handles(branch), *upper.get_legend_handles_labels()[0]])
    periods = ", ".join(str(period) for period in np.unique(branch["period"]))
    return figure, f"periodic orbits of period {periods}"


def draw(options):
    branch = BranchFile(options.source)
    figure, what = (draw_curve if "second_parameter" in branch else draw_branch)(branch, options)
    style.title(figure, branch, ", ".join([what, *values_of(branch.attributes, sorted(swept_pointers(branch.scene)))]))
    style.save(figure, options)


def main(arguments_given):
    arguments = command_line.parser(__doc__, source="BRANCH.h5", line=False)
    command_line.run(draw, arguments.parse_args(arguments_given))

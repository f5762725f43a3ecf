"""Orbits with their Poincaré sections (as the paper's Fig. 9); beside a single one the force on each blade.

  rubatlas-plot orbit ORBIT.h5 [ORBIT.h5 ...] -o PICTURE.png [--revolutions 3]

The circle is the clearance, around the middle of the ring: as long as the shaft centre stays inside, no blade can
touch, wherever it points. The forces are those of the last revolutions, contact by contact from touch-down to lift-off;
their peaks are those of all revolutions. Several orbits of one rotor have a panel each, and no forces.
"""
import json

import numpy as np

from rubatlas import command_line
from rubatlas import style
from rubatlas.atlas_file import (DONE, AtlasError, clearance_of, printable, reading, swept_pointers, text, values_of,
                                 with_values)
from rubatlas.same_scene import require_same_machine


DATASETS = ("time", "state", "force", "sections", "contact_number", "contact_blade", "contact_time", "contact_force")


class OrbitFile:
    """An orbit as `rubatlas orbit` writes it, read whole, with what `style` asks of an atlas."""

    def __init__(self, path, name=None):
        """`name`: what errors call it, the path by default."""
        self.path = path
        with reading(path, "an orbit that `rubatlas orbit` has written", "orbit") as file:
            self.data = {name: file[name][...] for name in DATASETS}
            self.units = {name: text(file[name].attrs["units"]) for name in self.data}
            self.attributes = dict(file.attrs)
            self.scene = json.loads(file["scene_resolved"][()])
        self.further_axes = sorted(swept_pointers(self.scene))
        self.scene = with_values(self.scene, self.attributes)
        if self.attributes["status"] != DONE:
            revolution, why = (self.attributes[one] for one in ("failed_revolution", "status_detail_meaning"))
            raise AtlasError(f"{name or path}: no orbit to draw; the motion ended in revolution {revolution}: "
                             f"{text(why)}")

    def attribute(self, name):
        return printable(self.attributes.get(name, ""))

    def contacts(self, blade, since):
        """Time and force over all contacts of a blade that end after `since`: each from 0 to 0, NaN in between."""
        mine = self.data["contact_blade"] == blade
        time, force = self.data["contact_time"][mine], self.data["contact_force"][mine]
        begins = np.flatnonzero(np.diff(self.data["contact_number"][mine], prepend=-1))
        pieces = [(np.empty(0), np.empty(0))]
        for first, last in zip(begins, [*begins[1:], len(time)]):
            if time[last - 1] < since:
                continue
            own = time[first:last]
            pieces.append((np.concatenate([own[:1], own, own[-1:], [np.nan]]),
                           np.concatenate([[0.0], force[first:last], [0.0, np.nan]])))
        return np.concatenate([one for one, _ in pieces]), np.concatenate([one for _, one in pieces])

    def revolutions(self, time):
        """How many revolutions have passed at these times; the speed may ramp from one to the next."""
        ends = np.cumsum(2.0 * np.pi / self.speeds())
        return np.interp(time, np.concatenate([[0.0], ends]), np.arange(len(ends) + 1))

    def speeds(self):
        """The speed ratio in each revolution."""
        rate = (self.scene.get("speed_ramp") or {}).get("rate", 0.0)
        return float(self.attributes["speed_ratio"]) + rate * np.arange(len(self.data["sections"]))

    def values(self):
        """Its point, in words: one entry for each quantity of the grid. A speed that ramps is named from the first
        revolution to the last."""
        found = values_of(self.attributes, self.further_axes)
        first, last = self.speeds()[[0, -1]]
        return [f"speed ratio {first:g} to {last:g}", *found[1:]] if first != last else found

    def describe(self):
        return ", ".join(self.values())


# An orbit that is smaller than this share of the clearance circle would be a dot in it.
SMALL = 0.25


def corner_of(plane, x, y, size):
    """Place of an inset, in shares of the axes: the corner that has the fewest points of the orbit in it."""
    places = plane.transAxes.inverted().transform(plane.transData.transform(np.column_stack([x, y])))
    corners = [(low, high) for high in (1.0 - size, 0.0) for low in (1.0 - size, 0.0)]
    return min(corners, key=lambda corner: np.all((places > corner) & (places < np.add(corner, size)), axis=1).sum())


def zoom_into(plane, x, y, circle):
    """The limits of the plane around a small orbit, and the whole clearance circle as an inset."""
    half = 0.7 * max(np.ptp(x), np.ptp(y), 1e-6 * np.ptp(circle[0]))
    middle = [0.5 * (values.min() + values.max()) for values in (x, y)]
    plane.set_xlim(middle[0] - half, middle[0] + half)
    plane.set_ylim(middle[1] - half, middle[1] + half)
    size = 0.3
    plane.lines[0].set(lw=0.8, alpha=0.8)
    inset = plane.inset_axes([*corner_of(plane, x, y, size), size, size])
    inset.plot(*circle, color=style.GREY, lw=0.8, ls=(0, (4, 3)))
    inset.plot(middle[0], middle[1], "s", markersize=3.5, color=style.VERMILION, markeredgewidth=0)
    inset.set_aspect("equal")
    inset.margins(0.15)
    inset.set(xticks=[], yticks=[])
    inset.spines[:].set_visible(True)


def plane_into(plane, orbit):
    """The orbit, its sections, and the clearance circle; a small orbit fills the plane, and the circle is an inset."""
    units, factor = style.drawn(orbit.units["state"])
    x, y = factor * orbit.data["state"][:, 0], factor * orbit.data["state"][:, 1]
    sections = factor * orbit.data["sections"]
    clearance = clearance_of(orbit.scene)
    ring_centre = -orbit.scene["rotor"]["misalignment"]
    plane.plot(x, y, color=style.BLUE, lw=0.45, alpha=0.45, label="orbit")
    plane.plot(sections[:, 0], sections[:, 1], "o", color=style.VERMILION,
               markersize=3.2, markeredgewidth=0, label="section, once per revolution")
    angle = np.linspace(0.0, 2.0 * np.pi, 361)
    circle = factor * clearance * np.cos(angle), factor * (ring_centre + clearance * np.sin(angle))
    plane.plot(*circle, color=style.GREY, lw=1.0, ls=(0, (4, 3)), label=f"clearance {1e3 * clearance:g} mm")
    plane.plot(0.0, factor * ring_centre, "+", color=style.GREY, markersize=6, label="middle of the ring")
    plane.set_aspect("equal")
    if max(np.ptp(x), np.ptp(y)) < SMALL * 2.0 * factor * clearance:
        zoom_into(plane, x, y, circle)
    plane.set_xlabel(f"x [{units}]")
    plane.set_ylabel(f"y [{units}]")


DASHES = ["-", "--", ":", "-."]  # of blades, which tell them apart in greyscale


def forces_into(forces, orbit, revolutions=3):
    """The force on each blade over the last revolutions; its peak is that of the whole orbit, which stands beside."""
    revolution = orbit.revolutions(orbit.data["time"])
    last = revolution >= revolution[-1] - revolutions
    for blade in range(orbit.data["force"].shape[1]):
        time, force = orbit.contacts(blade + 1, orbit.data["time"][last][0])
        of_orbit = orbit.data["contact_force"][orbit.data["contact_blade"] == blade + 1]
        peak = f", up to {of_orbit.max():.4g} {orbit.units['contact_force']}" if len(of_orbit) else ", no contact"
        forces.plot(orbit.revolutions(time), force, DASHES[blade % len(DASHES)], lw=1.0,
                    color=style.CYCLE[blade % len(style.CYCLE)], label=f"blade {blade + 1}{peak}")
    total = len(orbit.data["sections"])
    shown = f"; the last {revolutions} of {total}, peaks of all" if revolutions < total else ""
    forces.set_xlabel(f"Time [revolutions]{shown}")
    forces.set_ylabel(f"Normal force on a blade [{orbit.units['contact_force']}]")
    forces.set_ylim(bottom=0)
    forces.set_xlim(revolution[last][0], revolution[-1])


def forces_beside(options, orbit):
    """One orbit, and the forces on its blades."""
    figure, ((plane, forces),) = style.subplots(options, 1, 2, (10.0, 4.9), widths=[1, 1.1])
    plane_into(plane, orbit)
    style.legend(plane, options, place="below")
    forces_into(forces, orbit, options.revolutions)
    if orbit.data["force"].shape[1] <= 8:
        style.legend(forces, options, place="below")
    style.title(figure, orbit, orbit.describe())
    return figure


def side_by_side(options, orbits):
    """Several orbits, two in a row if there is room, each with what only it has above it."""
    for other in orbits[1:]:
        require_same_machine(orbits[0].path, orbits[0].scene, other.path, other.scene)
    common = [value for value in orbits[0].values() if all(value in orbit.values() for orbit in orbits)]
    own = [", ".join(value for value in orbit.values() if value not in common) for orbit in orbits]
    columns = 1 if style.is_narrow(options) else 2
    rows = -(-len(orbits) // columns)
    figure = style.figure(options, (8.5, 0.9 + (3.1 if columns == 1 else 4.1) * rows))
    grid = figure.add_gridspec(rows + 1, columns, height_ratios=[1] * rows + [0.01])
    planes = [figure.add_subplot(place) for place in list(grid)[:len(orbits)]]
    for number, (plane, orbit) in enumerate(zip(planes, orbits)):
        plane_into(plane, orbit)
        plane.set_aspect("equal", adjustable="datalim")  # panels of one size
        plane.set_title(own[number])
        if number % columns:
            plane.set_ylabel("")
        if number + columns < len(orbits):
            plane.set_xlabel("")
    style.title(figure, orbits[0], f"{', '.join(common)}\n\n{own[0]}")
    bottom = figure.add_subplot(grid[rows, :])
    bottom.set_axis_off()
    style.legend(bottom, options, planes[0].get_legend_handles_labels()[0], place="below")
    return figure


def draw(options):
    orbits = [OrbitFile(path) for path in options.orbits]
    figure = forces_beside(options, orbits[0]) if len(orbits) == 1 else side_by_side(options, orbits)
    style.save(figure, options)


def main(arguments_given):
    arguments = command_line.parser(__doc__, source="ORBIT.h5", line=False)
    arguments.add_argument("more", nargs="*", metavar="ORBIT.h5")
    arguments.add_argument("--revolutions", type=command_line.positive(int), default=3,
                           help="how many of the last to show forces of")
    chosen = arguments.parse_args(arguments_given)
    chosen.orbits = [chosen.source, *chosen.more]
    command_line.run(draw, chosen)

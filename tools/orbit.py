#!/usr/bin/python3
"""Orbit of one grid point with its Poincaré sections, and the force on each blade.

  tools/orbit.py ORBIT.h5 -o PICTURE.png [--revolutions 3]

The circle is the clearance: as long as the shaft centre stays inside, no blade can touch, wherever it points. The
forces are those of the last revolutions.
"""
import json

import h5py
import numpy as np

import command_line
import style
from atlas_file import AtlasError


class OrbitFile:
    """An orbit as `rubatlas orbit` writes it, with what `style` needs of an atlas."""

    def __init__(self, path):
        self.path = path
        try:
            with h5py.File(path, "r") as file:
                self.data = {name: file[name][...] for name in ("time", "x", "y", "force", "poincare")}
                self.attributes = {key: value for key, value in file.attrs.items()}
                self._units = {name: file[name].attrs["units"] for name in self.data}
                self._names = {name: file[name].attrs["long_name"] for name in self.data}
                self.scene = json.loads(file["scene_resolved"][()])
        except (OSError, KeyError) as error:
            raise AtlasError(f"{path}: not an orbit that `rubatlas orbit` has written ({error})") from None

    def attribute(self, name):
        value = self.attributes.get(name, "")
        return value.decode() if isinstance(value, bytes) else str(value)

    def units(self, name):
        units = self._units[name]
        units = units.decode() if isinstance(units, bytes) else units
        return "-" if units == "1" else units

    def long_name(self, name):
        text = self._names[name]
        return text.decode() if isinstance(text, bytes) else text


def draw(options):
    orbit = OrbitFile(options.source)
    scene = orbit.scene
    units, factor = style.drawn(orbit.units("x"))
    clearance = scene["ring"]["radius"] - scene["blades"]["hub_radius"] - scene["blades"]["length"]
    ring_centre = -scene["rotor"]["misalignment"]

    figure, (plane, forces) = style.plt.subplots(1, 2, figsize=(10.0, 4.9), gridspec_kw={"width_ratios": [1, 1.1]})
    plane.plot(factor * orbit.data["x"], factor * orbit.data["y"], color=style.BLUE, lw=0.5, alpha=0.8, label="orbit")
    plane.plot(factor * orbit.data["poincare"][:, 0], factor * orbit.data["poincare"][:, 1], "o", color=style.VERMILION,
               markersize=3.2, markeredgewidth=0, label="section, once per revolution")
    angle = np.linspace(0.0, 2.0 * np.pi, 361)
    plane.plot(factor * clearance * np.cos(angle), factor * (ring_centre + clearance * np.sin(angle)), color=style.GREY,
               lw=1.0, ls=(0, (4, 3)), label=f"clearance {1e3 * clearance:g} mm")
    plane.set_aspect("equal")
    plane.set_xlabel(f"x [{units}]")
    plane.set_ylabel(f"y [{units}]")
    plane.legend(loc="upper left", bbox_to_anchor=(0.0, -0.12), ncol=3, columnspacing=1.0, handlelength=1.6)

    samples = scene["protocol"]["samples_per_revolution"] * options.revolutions
    last = slice(max(0, len(orbit.data["time"]) - samples - 1), None)
    per_revolution = scene["protocol"]["samples_per_revolution"]
    revolution = np.arange(len(orbit.data["time"]))[last] / per_revolution
    for blade in range(orbit.data["force"].shape[1]):
        forces.plot(revolution, orbit.data["force"][last, blade], lw=1.0, color=style.CYCLE[blade % len(style.CYCLE)],
                    label=f"blade {blade + 1}")
    forces.set_xlabel("Time [revolutions]")
    forces.set_ylabel(f"Normal force on a blade [{orbit.units('force')}]")
    forces.set_ylim(bottom=0)
    forces.set_xlim(revolution[0], revolution[-1])
    if orbit.data["force"].shape[1] <= 8:
        forces.legend(loc="upper left", bbox_to_anchor=(0.0, -0.12), ncol=4)
    style.title(figure, orbit, orbit.attribute("point") or "")
    style.save(figure, options.output)


if __name__ == "__main__":
    arguments = command_line.parser(__doc__, source="ORBIT.h5", line=False)
    arguments.add_argument("--revolutions", type=int, default=3, help="how many of the last to show forces of")
    command_line.run(draw, arguments.parse_args())

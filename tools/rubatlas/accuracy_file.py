"""Reads a study of accuracy as `rubatlas accuracy` writes it, and compares its sections with reference data.

Arrays have the settings first and all points of the grid behind; what did not end as done is NaN.
"""
import json

import numpy as np

from rubatlas.atlas_file import (DONE, AtlasError, clearance_of, counted, printable, reading, swept_pointers, text,
                                 with_values)

# Parameters of a reference case, and where a resolved scene states them.
PARAMETERS = {"R": "/ring/radius", "L": "/blades/length", "rh": "/blades/hub_radius", "m": "/rotor/mass",
              "omega_n": "/rotor/natural_frequency", "E": "/blades/youngs_modulus", "b": "/blades/width",
              "y0": "/rotor/misalignment", "n": "/blades/count"}
SWEPT = {"Omega": "speed_ratio", "zeta": "damping_ratio", "mu": "friction", "me": "unbalance", "h": "thickness"}


class AccuracyFile:
    """A study, read whole, with what `style` asks of an atlas."""

    def __init__(self, path):
        self.path = str(path)
        with reading(path, "a study that `rubatlas accuracy` has written", "accuracy") as file:
            self.data = {name: file[name][()] for name in file if file[name].dtype.kind in "fiu"}
            self.words = [text(word) for word in file["method"][...]]
            self.attributes = dict(file.attrs)
            self.scene = json.loads(file["scene_resolved"][()])
            self.axes = [next(iter(dimension.values())).name.strip("/") for dimension in file["status"].dims][1:]
            self.repeats = int(file.attrs["repeats"])
        self.done = self._flat("status") == DONE

    def __getitem__(self, name):
        """A dataset with one number per setting."""
        return self.data[name]

    def attribute(self, name):
        return printable(self.attributes.get(name, ""))

    def _flat(self, name):
        """(settings, points), or (points) for data that do not depend on the setting."""
        values = self.data[name]
        return values.reshape(-1) if name == "horizon" else values.reshape(len(self.words), -1)

    def point_count(self):
        return self.done.shape[1]

    def points(self):
        """Parameters of each point, in the order of the arrays."""
        grids = np.meshgrid(*(self.data[name] for name in self.axes), indexing="ij")
        return {name: grid.reshape(-1) for name, grid in zip(self.axes, grids)}

    def methods(self):
        """Names in the order of the study, each once; the reference does not count as a method."""
        return list(dict.fromkeys(self.words[1:]))

    def of(self, method):
        """Settings of a method without the reference."""
        return np.array([i for i, word in enumerate(self.words) if i > 0 and word == method], dtype=int)

    def ladders(self, method):
        """Settings of a method, one array per increment of force."""
        settings, increments = self.of(method), self.data["force_increment"]
        keys = np.nan_to_num(increments[settings], nan=-1.0)
        return [settings[keys == key] for key in sorted(set(keys), reverse=True)]

    def knobs(self, setting):
        names = {"tolerance": "tolerance", "force_increment": "dF [N]", "step": "step"}
        return ", ".join(f"{words} {self.data[name][setting]:g}" for name, words in names.items()
                         if np.isfinite(self.data[name][setting]))

    def revolutions(self):
        return self.scene["protocol"]["transient_revolutions"] + self.scene["protocol"]["sampled_revolutions"]

    def predictable(self):
        """Points at which two tight runs agree to the end."""
        return self._flat("horizon") == self.revolutions()

    def describe(self):
        protocol = self.scene["protocol"]
        revolutions = f"{protocol['transient_revolutions']} + {protocol['sampled_revolutions']} revolutions"
        return (f"{counted(self.point_count(), 'points')}, {revolutions} each, least of "
                f"{counted(self.repeats, 'runs')}")

    def mean(self, name, points):
        """Mean over some points, one number per setting; a run that ended early counts with its cost up to there."""
        return self._flat(name)[:, points].mean(axis=1)

    def complete(self, points):
        """Settings at which all of some points ran to the end, so that their costs can be compared."""
        return self.done[:, points].all(axis=1)

    def worst_error(self, points):
        """Largest trajectory error over some points, a number per setting; NaN where a point did not run to the end."""
        return worst(self._flat("trajectory_error")[:, points])

    def clearance(self, point):
        return clearance_of(with_values(self.scene, {name: values[point] for name, values in self.points().items()}))

    # --- reference data ---

    def cases(self, path):
        """Point number → reference case, where scene and case are the same rotor from the same start."""
        try:
            with open(path, encoding="utf-8") as file:
                cases = json.load(file)["cases"]
        except (OSError, ValueError, KeyError) as error:
            raise AtlasError(f"{path}: not reference data ({error})") from None
        points, starts = self.points(), self.data["start"].reshape(-1, 4)
        found: dict[int, dict] = {}
        if self.scene["contact"]["law"] != "elastica":
            return found
        for case in cases:
            wanted = case["params"]
            start = np.array(case.get("initial_state", [0.0] * 4), dtype=float)
            same = np.all(starts == start, axis=1)
            for name, pointer in PARAMETERS.items():
                same &= self._stated(pointer) == wanted[name]
            for name, axis in SWEPT.items():
                same &= np.abs(points[axis] - wanted[name]) <= 1e-12 * max(abs(wanted[name]), 1e-12)
            found.update({int(point): case for point in np.flatnonzero(same)})
        return found

    def _stated(self, pointer):
        """The scene's value; one value per point where its grid sweeps the quantity by this pointer."""
        name = pointer.strip("/").replace("/", "_")
        if name in swept_pointers(self.scene):
            return self.points()[name]
        section, key = pointer.strip("/").split("/")
        return self.scene[section][key]

    def require_reference(self, path):
        if not self.cases(path):
            raise AtlasError(f"{path}: no case has the rotor and the start of a point of {self.path}")

    def error_against(self, path, points):
        """Largest distance from the reference data over the clearance, one number per setting.

        Periodic cases: the last sections, where the study's are those of the same revolutions. Others: the first
        sections, within the horizon. NaN where no case is among the points.
        """
        distances = np.full((len(self.words), self.point_count()), np.nan)
        first = self._sections("first_sections")
        last = self._sections("last_sections")
        horizon = self._flat("horizon")
        for point, case in self.cases(path).items():
            if not points[point]:
                continue
            if horizon[point] < self.revolutions():
                known = np.array(case["sections_1_to_10"])
                count = min(len(known), first.shape[2], int(horizon[point]))
                difference = first[:, point, :count] - known[:count]
            elif case["last_section_index"] == self.revolutions():
                known = np.array(case["sections_last_11"])
                count = min(len(known), last.shape[2])
                difference = last[:, point, last.shape[2] - count:] - known[len(known) - count:]
            else:
                continue
            if count:
                distances[:, point] = np.linalg.norm(difference, axis=2).max(axis=1) / self.clearance(point)
        return worst(distances[:, points & np.isfinite(distances).any(axis=0)])

    def _sections(self, name):
        values = self.data[name]
        return values.reshape(len(self.words), self.point_count(), *values.shape[-2:])


def worst(errors):
    """Row by row; NaN where a row has no column, or a NaN."""
    return errors.max(axis=1) if errors.shape[1] else np.full(len(errors), np.nan)

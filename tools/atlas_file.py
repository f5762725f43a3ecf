"""Reads an atlas: its axes, the rows that are done, and one line picked by its parameters.

An atlas is one HDF5 file. Every dataset has the axes of the grid first, the last of them `speed_ratio`; all points that
differ in speed ratio only are a line. Large datasets are allocated early and never filled: what stands in a row whose
status is not "done" means nothing, so everything is read through `/status` here and such rows come back as NaN.

    from atlas_file import AtlasFile
    with AtlasFile("damping.h5") as atlas:
        line = atlas.line(damping_ratio=0.1)
        speed, displacement = atlas.axis("speed_ratio"), line.rows("max_displacement")
"""
import json

import h5py
import numpy as np

PENDING, DONE, LEFT_VALIDITY, INTEGRATOR_FAILED = 0, 1, 2, 3

# Where the scene states the one value of a quantity that is not swept, or the paper's value of one that is.
SCENE_VALUE = {
    "damping_ratio": ("rotor", "damping_ratio"),
    "friction": ("contact", "friction"),
    "unbalance": ("unbalance", "moment"),
    "thickness": ("blades", "thickness"),
}
DIRECTIONS = ["up", "down"]
# As in the paper; a picture's axes have little room for words.
SYMBOL = {"speed_ratio": "Ω", "damping_ratio": "ζ", "friction": "μ", "unbalance": "me", "thickness": "h"}


def swept_pointers(scene):
    """Axes that the scene's grid names by a JSON pointer: name of the dimension → (section, key)."""
    return {key.strip("/").replace("/", "_"): tuple(key.strip("/").split("/"))
            for key in scene.get("grid", {}) if key.startswith("/")}


def with_values(scene, values):
    """The scene with values (by the names of axes) of quantities that its grid names by pointers written in."""
    own = {name: dict(part) if isinstance(part, dict) else part for name, part in scene.items()}
    for name, (section, key) in swept_pointers(scene).items():
        own[section][key] = float(values[name])
    return own


def clearance_of(scene):
    """δc = R − rh − L [m], the radial gap between ring and blade tip of the centred rotor."""
    return scene["ring"]["radius"] - scene["blades"]["hub_radius"] - scene["blades"]["length"]


class AtlasError(Exception):
    """What was asked for is not in the file; the text says what is."""


def text(value):
    """A string as HDF5 hands it out, which may be bytes."""
    return value.decode() if isinstance(value, bytes) else str(value)


class AtlasFile:
    """An atlas (or a file on the same axes, such as the maps that `rubatlas analyse` writes), open for reading."""

    def __init__(self, path):
        self.path = str(path)
        try:
            self.file = h5py.File(path, "r")
        except OSError as error:
            raise AtlasError(f"{path}: not a readable HDF5 file ({error})") from None
        grid = self.file.get("status", self.file.get("class"))
        if grid is None:
            self.file.close()
            raise AtlasError(f"{path}: neither /status nor /class is there; this is no atlas")
        self.axes = [self._scale(grid, dimension) for dimension in range(grid.ndim)]
        scene = self.file.get("scene_resolved")
        self.scene = json.loads(text(scene[()])) if scene is not None else {}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.file.close()

    @staticmethod
    def _scale(dataset, dimension):
        return next(iter(dataset.dims[dimension].values())).name.strip("/")

    def __contains__(self, name):
        return name in self.file

    def dataset(self, name):
        """The dataset of that name; AtlasError names the observables that the atlas has instead."""
        if name not in self.file:
            kept = [key for key in self.file if self._is_row_dataset(key)]
            raise AtlasError(f"{self.path}: /{name} is not in this file, which has {', '.join(kept)}; "
                             "name it among the scene's observables")
        return self.file[name]

    def _is_row_dataset(self, name):
        dataset = self.file[name]
        return isinstance(dataset, h5py.Dataset) and dataset.ndim >= len(self.axes) and \
            not h5py.h5ds.is_scale(dataset.id)

    def axis(self, name):
        """Values of an axis, or of an inner one such as `order`."""
        return self.dataset(name)[...]

    def units(self, name):
        """Unit of a dataset as the file states it; "-" for a number without one."""
        units = text(self.dataset(name).attrs.get("units", "1"))
        return "-" if units in ("1", "") else units

    def long_name(self, name):
        """What a dataset is, in words, as the file states it."""
        return text(self.dataset(name).attrs.get("long_name", name.replace("_", " ")))

    def attribute(self, name):
        """Root attribute as text, empty where it is not there."""
        return text(self.file.attrs.get(name, ""))

    @property
    def clearance(self):
        """δc of the scene [m]; where lengths are swept, that of its first line: ask the line that you look at."""
        return clearance_of(self.scene)

    def swept_axes(self):
        """Axes with more than one value, apart from the speed ratio."""
        return [name for name in self.axes[:-1] if self.dataset(name).size > 1]

    def _index(self, name, wanted):
        values = self.axis(name)
        if wanted is None:
            section, key = SCENE_VALUE.get(name, (None, None))
            usual = (self.scene.get(section) or {}).get(key, values[0])
            return int(np.argmin(np.abs(values - usual)))
        if name == "direction" and wanted in DIRECTIONS:
            wanted = DIRECTIONS.index(wanted)
        wanted = float(wanted)
        index = int(np.argmin(np.abs(values - wanted)))
        # The axis holds decimals as binary64; nine digits tell neighbours apart and forgive rounding.
        if abs(values[index] - wanted) > 1e-9 * max(abs(wanted), abs(values[index])):
            listed = ", ".join(format(value, "g") for value in values)
            raise AtlasError(f"{self.path}: {name} {wanted:g} is not in this atlas, which has {listed}")
        return index

    def line(self, **wanted):
        """The line at the given values, e.g. `damping_ratio=0.1`; what is not given has the scene's own value."""
        unknown = set(wanted) - set(self.axes[:-1])
        if unknown:
            raise AtlasError(f"{self.path}: no axis {', '.join(sorted(unknown))}; "
                             f"a line is picked by {', '.join(self.axes[:-1])}")
        return Line(self, tuple(self._index(name, wanted.get(name)) for name in self.axes[:-1]))

    def lines(self, axis, **wanted):
        """All lines along one axis, in the order of its values; the other axes as in `line`."""
        return [self.line(**{**wanted, axis: value}) for value in self.axis(axis)]


class Line:
    """All points of an atlas that differ in speed ratio only."""

    def __init__(self, atlas, index):
        self.atlas = atlas
        self.index = index

    def value(self, axis):
        """The line's value on an axis."""
        return self.atlas.axis(axis)[self.index[self.atlas.axes.index(axis)]]

    @property
    def scene(self):
        """The atlas' scene with the line's own value of every quantity that is swept by its pointer."""
        return with_values(self.atlas.scene, {name: self.value(name) for name in swept_pointers(self.atlas.scene)})

    @property
    def clearance(self):
        return clearance_of(self.scene)

    def status(self):
        return self.atlas.dataset("status")[self.index]

    def rows(self, name):
        """Rows of an observable, (speeds, ...); NaN throughout where the point is not done."""
        values = self.atlas.dataset(name)[self.index].astype(float)
        values[self.status() != DONE] = np.nan
        return values

    def raw(self, name):
        """Rows as they stand in the file, for data that have a code of their own for "nothing here"."""
        return self.atlas.dataset(name)[self.index]

    def describe(self, without=()):
        """For a title: "damping ratio 0.1, friction 0.1, ..."; axes in `without` are left out."""
        parts = []
        for name in self.atlas.axes[:-1]:
            if name in without:
                continue
            value = self.value(name)
            if name == "direction":
                parts.append(f"swept {DIRECTIONS[int(value)]}")
                continue
            units = self.atlas.units(name)
            parts.append(f"{name.replace('_', ' ')} {value:g}" + ("" if units == "-" else f" {units}"))
        return ", ".join(parts)

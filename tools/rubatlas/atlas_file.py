"""Reads an atlas: its axes, the rows that are done, and one line picked by its parameters.

An atlas is one HDF5 file. Every dataset has the axes of the grid first, the last of them `speed_ratio`; all points that
differ in speed ratio only are a line. Large datasets are allocated early and never filled: what stands in a row whose
status is not "done" means nothing, so everything is read through `/status` here and such rows come back as NaN.

    from rubatlas.atlas_file import AtlasFile
    with AtlasFile("damping.h5") as atlas:
        line = atlas.line(damping_ratio=0.1)
        speed, displacement = atlas.axis("speed_ratio"), line.rows("max_displacement")
"""
import contextlib
import json
import os
import pathlib
import re

import h5py
import numpy as np

# Layout of maps that is read here; the names of their datasets are new in it.
MAPS_VERSION = "6"

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


def words_of(attributes):
    """Words of a dataset whose values are flags, by value; empty where they are numbers."""
    meanings = text(attributes.get("flag_meanings", "")).split()
    values = np.atleast_1d(attributes.get("flag_values", np.arange(len(meanings))))
    return {int(value): word.replace("_", " ") for value, word in zip(values, meanings)}


def number_of(axis, wanted):
    """A value on an axis as a number."""
    try:
        return float(wanted)
    except (TypeError, ValueError):
        words = f" or one of {', '.join(DIRECTIONS)}" if axis == "direction" else ""
        raise AtlasError(f"{axis} {wanted!r}: a number{words} is wanted") from None


def same_value(one, other):
    """Whether two numbers are one value of an axis, which holds decimals as binary64: nine digits distinguish
    neighbours and allow for rounding. NaN and infinity are no values."""
    return np.isfinite(other) and abs(one - other) <= 1e-9 * max(abs(one), abs(other))


def values_of(attributes, further=()):
    """The point that attributes of a file name, in words: one entry for each quantity of the grid."""
    units = {"unbalance": " kg m", "thickness": " m"}
    names = ("speed_ratio", "damping_ratio", "friction", "unbalance", "thickness", *further)
    return [f"{name.replace('_', ' ')} {attributes[name]:g}{units.get(name, '')}" for name in names
            if name in attributes]


def swept_pointers(scene):
    """Axes that the scene's grid names by a JSON pointer: name of the dimension → (section, key)."""
    return {key.strip("/").replace("/", "_"): tuple(key.strip("/").split("/"))
            for key in scene.get("grid", {}) if key.startswith("/")}


def with_values(scene, values):
    """The scene with values (by the names of axes) of quantities that its grid names by pointers written in."""
    own = {name: dict(part) if isinstance(part, dict) else part for name, part in scene.items()}
    for name, (section, key) in swept_pointers(scene).items():
        own[section][key] = values[name]
    return own


def clearance_of(scene):
    """δc = R − rh − L [m], the radial gap between ring and blade tip of the centred rotor."""
    return scene["ring"]["radius"] - scene["blades"]["hub_radius"] - scene["blades"]["length"]


def sizes_of(scene):
    """What units are multiples of that depend on the rotor, as `rubatlas.query` has them; the scene's numbers may be
    arrays."""
    return {"clearance": clearance_of(scene), "radian_per_second": 1.0 / scene["rotor"]["natural_frequency"]}


def beside(path, what):
    """ATLAS_maps.h5 (or _edges) beside ATLAS.h5, where it is there; else None."""
    source = pathlib.Path(path)
    place = source.with_name(f"{source.stem}_{what}.h5")
    return str(place) if place.is_file() else None


class AtlasError(Exception):
    """The file does not contain what was asked for; the text says what it contains."""


class UnreadableFile(AtlasError):
    """The file is not there, is damaged, or not of the kind that it should be."""


def text(value):
    """A string as HDF5 hands it out, which may be bytes."""
    return value.decode() if isinstance(value, bytes) else str(value)


def counted(number, things):
    """A number of things, in words: "1 point", "2 points"."""
    return f"{number} {things.removesuffix('s') if number == 1 else things}"


def printable(value):
    """A text without the control characters that would steer a terminal."""
    return re.sub("[\x00-\x1f\x7f-\x9f]", "", text(value))


# Exceptions of h5py for data that are missing, of another kind, or damaged.
UNREADABLE = (OSError, KeyError, ValueError, RuntimeError, TypeError, IndexError, AttributeError, StopIteration)

EDGES = "a file of edges that `rubatlas edges` has written"  # as `reading` names it


@contextlib.contextmanager
def reading(path, what, *kinds):
    """The HDF5 file at `path`, of one of these kinds, open within the block; what cannot be read is not `what`."""
    if not os.path.exists(path):
        raise UnreadableFile(f"{path}: no such file")
    if not os.path.isfile(path):
        raise UnreadableFile(f"{path}: not a file")
    try:
        with open(path, "rb") as content:
            if content.read(1) == b"{":
                raise AtlasError(f"{path}: a text in braces, such as a scene, where {' or '.join(kinds)} is wanted")
        with h5py.File(path, "r") as file:
            kind = text(file.attrs.get("kind", kinds[0]))  # older files do not say it
            if kind not in kinds:
                raise AtlasError(f"{path}: a file of the kind {kind}, where {' or '.join(kinds)} is wanted")
            yield file
    except UNREADABLE:
        raise UnreadableFile(f"{path}: not {what}, or damaged") from None


SOMETIMES = ("seam", "settled")  # rows of scenes whose lines are cut, whose transients end on cycles
# Observables in descending rows of which a query and the page of a report take the first number, with what it is.
FIRST_OF_ROW = {"lyapunov": "largest Lyapunov exponent per unit tau; positive: chaotic"}


class _Examination:
    """Compares the datasets of a file that lies on the axes of an atlas with these axes, once."""

    KINDS = {"status": "u", "restarted": "u", "seam": "u", "settled": "u", "failed_revolution": "i", "class": "u",
             "class_blade_passing": "u", "attractor": "i", "grazing_side": "u"}

    def __init__(self, path, file):
        self.path, self.file = path, file
        self.examined = {}  # datasets by name: of scales there are few, and many run along them

    def refuse(self, fact):
        raise UnreadableFile(f"{self.path}: {fact}; the file is damaged, or not one of rubatlas")

    def dataset(self, name):
        if name in self.examined:
            return self.examined[name]
        link = self.file.get(name, getlink=True)
        if link is None:
            self.refuse(f"/{name} is missing")
        if not isinstance(link, h5py.HardLink) or not isinstance(self.file[name], h5py.Dataset):
            self.refuse(f"/{name} is no dataset of this file")
        dataset = self.file[name]
        if dataset.external or dataset.is_virtual:
            self.refuse(f"/{name} keeps its numbers in another file")
        self.examined[name] = dataset
        return dataset

    def scale(self, dataset, dimension):
        """Name of the scale that an axis of a dataset runs along, of the axis' length."""
        scales: list[h5py.h5d.DatasetID] = []
        try:
            h5py.h5ds.iterate(dataset.id, dimension, scales.append, 0)  # `dataset.dims` takes twice as long
            names = [text(name) for scale in scales if (name := h5py.h5i.get_name(scale))]
        except UNREADABLE:  # it was taken out of the file
            names = []
        if not names:
            self.refuse(f"axis {dimension} of {dataset.name} has no scale")
        name = names[0].strip("/")
        length, shape = dataset.shape[dimension], self.dataset(name).shape
        if shape != (length,):
            self.refuse(f"{dataset.name} is {length} long where its scale /{name} is {shape}")
        return name

    def numbers(self, name, axes):
        """A dataset with a row per point: its kind, and its axes."""
        dataset = self.dataset(name)
        if dataset.dtype.kind != self.KINDS.get(name, "f"):
            self.refuse(f"/{name} does not hold the numbers that it should")
        if dataset.ndim < len(axes):
            self.refuse(f"/{name} has the shape {dataset.shape}, with fewer axes than its grid")
        found = [self.scale(dataset, dimension) for dimension in range(dataset.ndim)]
        if found[:len(axes)] != axes:
            self.refuse(f"/{name} runs along {', '.join(found)}, not along {', '.join(axes)}")
        return dataset

    def scene(self):
        dataset = self.dataset("scene_resolved")
        try:
            scene = json.loads(text(dataset[()]))
            # The attributes that pictures need.
            for part, key in (("rotor", "damping_ratio"), ("rotor", "natural_frequency"), ("blades", "length"),
                              ("ring", "radius"), ("contact", "friction"),
                              ("protocol", "transient_revolutions"), ("grid", "speed_ratio")):
                scene[part][key]
            return scene
        except (ValueError, KeyError, TypeError):
            self.refuse("/scene_resolved is not a scene")

    def axes(self):
        grid = next((name for name in ("status", "class") if name in self.file), None)
        if grid is None:
            raise AtlasError(f"{self.path}: neither /status nor /class is there; this is no atlas")
        if grid == "class" and text(self.file.attrs.get("schema_version", "")) != MAPS_VERSION:
            raise AtlasError(f"{self.path}: these maps are of another version than {MAPS_VERSION}; `rubatlas analyse "
                             "ATLAS.h5 -o MAPS.h5 --overwrite` makes them anew")
        dataset = self.dataset(grid)
        if dataset.ndim == 0:
            self.refuse(f"/{grid} is one number, not one per point")
        axes = [self.scale(dataset, dimension) for dimension in range(dataset.ndim)]
        for name in axes:
            values = self.file[name]
            if values.dtype.kind != "f" or not (np.isfinite(values[...]).all() and (np.diff(values[...]) > 0).all()):
                self.refuse(f"/{name} does not hold ascending numbers")
        return axes

    def rows(self, axes, scene):
        names = [name for name in ("class", "class_blade_passing", "attractor") if name in self.file]
        if "status" in self.file:
            names = ["status", "restarted", *(name for name in SOMETIMES if name in self.file), "failed_revolution",
                     "final_state", *scene.get("observables", [])]
        for name in names:
            self.numbers(name, axes)
        if "status" not in self.file:
            return
        status = self.file["status"][...]
        if status.max() > INTEGRATOR_FAILED:
            self.refuse(f"/status has a {status.max()}, and no status is above {INTEGRATOR_FAILED}")
        if not np.isfinite(self.file["final_state"][...][status == DONE]).all():
            self.refuse("/final_state of a point that is done is not finite")


class AtlasFile:
    """An atlas (or a file on the same axes, such as the maps that `rubatlas analyse` writes), open for reading."""

    def __init__(self, path, chosen=None):
        """`chosen`: which points of the grid to show, of its shape; without it all of them."""
        self.path = str(path)
        self.chosen = chosen
        with contextlib.ExitStack() as stack:
            self.file = stack.enter_context(reading(self.path, "a readable HDF5 file of rubatlas", "atlas", "maps"))
            examination = _Examination(self.path, self.file)
            self.axes = examination.axes()
            self.scene = examination.scene()
            examination.rows(self.axes, self.scene)
            self._stack = stack.pop_all()  # stays open

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._stack.pop_all().__exit__(None, None, None)

    def __contains__(self, name):
        return name in self.file

    def dataset(self, name):
        """The dataset of that name; AtlasError names the observables that the atlas has instead."""
        if name not in self.file:
            if "status" not in self.file and "class" in self.file:
                raise AtlasError(f"{self.path}: no /{name}; these are the maps of an atlas, "
                                 "which is what should be named")
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
        return printable(self.file.attrs.get(name, ""))

    def sizes(self, chosen=...):
        """`sizes_of` at the chosen points of the grid: for each size its different values."""
        swept = {name: self.axis(name).reshape([-1 if axis == name else 1 for axis in self.axes])
                 for name in swept_pointers(self.scene)}
        shape = [len(self.axis(name)) for name in self.axes]
        return {name: np.unique(np.broadcast_to(size, shape)[chosen])
                for name, size in sizes_of(with_values(self.scene, swept)).items()}

    def swept_axes(self):
        """Axes with more than one value, apart from the speed ratio."""
        return [name for name in self.axes[:-1] if self.dataset(name).size > 1]

    def index(self, name, wanted):
        """Place on an axis of a value, which must be there; of None that of the scene's own value."""
        values = self.axis(name)
        if wanted is None:
            return int(np.argmin(np.abs(values - self.own_value(name))))
        if name == "direction" and wanted in DIRECTIONS:
            wanted = DIRECTIONS.index(wanted)
        wanted = number_of(name, wanted)
        index = int(np.argmin(np.abs(values - wanted)))
        if not same_value(values[index], wanted):
            listed = ", ".join(format(value, "g") for value in values)
            raise AtlasError(f"{self.path}: {name} {wanted:g} is not in this atlas, which has {listed}")
        return index

    def own_value(self, name):
        """The scene's own value of what an axis sweeps; the axis' first value where the scene names none."""
        pointers = swept_pointers(self.scene)
        scene = self.scene
        if name in pointers:
            # /scene_resolved has the grid's first value there; what the scene itself says is in /scene alone.
            scene = json.loads(text(self.file["scene"][()])) if "scene" in self.file else {}
        section, key = {**SCENE_VALUE, **pointers}.get(name, (None, None))
        return (scene.get(section) or {}).get(key, self.axis(name)[0])

    def line(self, **wanted):
        """The line at the given values, e.g. `damping_ratio=0.1`; other axes have the scene's own value."""
        unknown = set(wanted) - set(self.axes[:-1])
        if unknown:
            raise AtlasError(f"{self.path}: no axis {', '.join(sorted(unknown))}; "
                             f"a line is picked by {', '.join(self.axes[:-1])}")
        return Line(self, tuple(self.index(name, wanted.get(name)) for name in self.axes[:-1]))

    def lines(self, axis, **wanted):
        """All lines along one axis, in the order of its values, without those of which no point is chosen; the other
        axes as in `line`."""
        lines = [self.line(**{**wanted, axis: value}) for value in self.axis(axis)]
        return [line for line in lines if line.chosen().any()] or lines


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

    def chosen(self):
        """Which of its points are to be shown."""
        if self.atlas.chosen is None:
            return np.ones(len(self.atlas.axis("speed_ratio")), dtype=bool)
        return self.atlas.chosen[self.index]

    def rows(self, name):
        """Rows of an observable, (speeds, ...); NaN throughout where the point is not done or not chosen."""
        values = self.atlas.dataset(name)[self.index].astype(float)
        values[(self.status() != DONE) | ~self.chosen()] = np.nan
        return values

    def raw(self, name):
        """Rows as they stand in the file, for data with a code of their own for points that are not done."""
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

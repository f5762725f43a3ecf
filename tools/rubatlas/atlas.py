"""An atlas to ask: an xarray Dataset behind it, masked by status, joined with the maps of `rubatlas analyse`.

    import rubatlas
    atlas = rubatlas.open("quick.h5")
    calm = atlas.sel(damping_ratio=0.1, speed_ratio=slice(0.3, 0.5)).where("class == 'period 1'")
    print(calm["max_displacement"].max().item())
"""
from __future__ import annotations

import contextlib
import html
import json
import os
import pathlib
import tempfile
from collections.abc import Iterator, Mapping
from typing import Any, overload

import numpy as np
import xarray

from rubatlas import query
from rubatlas.atlas_file import (DIRECTIONS, DONE, EDGES, FIRST_OF_ROW, SOMETIMES, AtlasError, AtlasFile, beside,
                                 counted, number_of, reading, same_value, sizes_of, swept_pointers, text, with_values,
                                 words_of)
from rubatlas.judgement import MAY_NOT_OCCUR, Judgement, bands_of
from rubatlas.plots.axes import Plots
from rubatlas.plots.orbit import OrbitFile
from rubatlas.program import Path, command, scene_file
from rubatlas.same_scene import require_edges_of, require_maps_of, require_same

# Points that are wanted, along axes of the selection or in its shape.
Mask = xarray.DataArray | np.ndarray[Any, np.dtype[np.bool_]]

# What the maps have for each point besides the margins.
_OF_MAPS = ("class", "class_blade_passing", "contact", "attractor", "exponent_check")


def _quantity(source: AtlasFile, dataset: Any, axes: list[str]) -> xarray.Variable:
    attributes = {"units": source.units(dataset.name), "long_name": source.long_name(dataset.name)}
    words = words_of(dataset.attrs)
    if words:
        attributes |= {"flag_values": list(words),
                       "flag_meanings": " ".join(word.replace(" ", "_") for word in words.values())}
    return xarray.Variable(axes, dataset[...], attributes)


def _joined(atlas: AtlasFile, maps: AtlasFile | None) -> dict[str, xarray.Variable]:
    """Everything with one number per point."""
    shape = atlas.dataset("status").shape
    found = {"status": _quantity(atlas, atlas.dataset("status"), atlas.axes)}
    for name in (*(name for name in SOMETIMES if name in atlas), *atlas.scene.get("observables", [])):
        dataset = atlas.dataset(name)
        if dataset.shape == shape:
            found[name] = _quantity(atlas, dataset, atlas.axes)
    if maps is None:
        return found
    for name in _OF_MAPS:
        if name in maps:
            found[name] = _quantity(maps, maps.dataset(name), atlas.axes)
    for name, dataset in maps.file.get("margins", {}).items():
        # The distance along the speed is called margin alone, as in the limits of safe speeds.
        name = name.removeprefix("along_")
        found["margin" if name == "speed_ratio" else f"margin_{name}"] = _quantity(maps, dataset, atlas.axes)
    return found


def read_edges(path: str) -> xarray.Dataset:
    """The group /edges of maps or of a file of `rubatlas edges`, one row per edge."""
    with reading(path, EDGES, "edges") as file:
        group = file["edges"]
        datasets = {name: dataset for name, dataset in group.items()
                    if dataset.ndim == 1 and dataset.dtype.kind in "fiu" and name != "edge"}
        columns = {name: xarray.Variable(("edge",), dataset[...], {
            "units": text(dataset.attrs.get("units", "1")), "long_name": text(dataset.attrs.get("long_name", name))})
                   for name, dataset in datasets.items()}
    return xarray.Dataset(columns)


def _flat(values: xarray.DataArray, chosen: xarray.DataArray) -> xarray.DataArray:
    """Numbers where a point is chosen, NaN elsewhere, with what the file says of them."""
    masked: xarray.DataArray = values.astype(float).where(chosen)
    masked.attrs.update(values.attrs)
    return masked


def _with_speed(call: str, bare: tuple[Any, ...], named: dict[str, Any]) -> dict[str, Any]:
    """What is asked for by the names of axes, where one value may stand without a name: the speed ratio."""
    if len(bare) > 1 or bare and "speed_ratio" in named:
        raise AtlasError(f"{call}: one value may stand without a name, the speed ratio; others are named, as in "
                         "damping_ratio=0.1")
    return {**({"speed_ratio": bare[0]} if bare else {}), **named}


class Atlas:
    """Points of an atlas, or a selection of them.

    `dataset` is an xarray Dataset over the axes of the grid; what is not done, or not selected, is NaN, and the words
    of flags (class, grazing side) are strings. Quantities with more than one number per point (sections, spectra) are
    read when they are asked for: `atlas["poincare"]`.
    """

    def __init__(self, path: Path, maps: Path | None = None, program: Path | None = None) -> None:
        self.path = str(path)
        self.program = program
        maps = maps if maps is not None else beside(path, "maps")
        self.maps_path = None if maps is None else str(maps)
        with AtlasFile(self.path) as atlas:
            self.scene: dict[str, Any] = atlas.scene
            self.axes: list[str] = atlas.axes
            axes = {name: xarray.Variable((name,), atlas.axis(name),
                                          {"units": atlas.units(name), "long_name": atlas.long_name(name)})
                    for name in atlas.axes}
            if self.maps_path is None:
                quantities = _joined(atlas, None)
            else:
                with AtlasFile(self.maps_path) as mapped:
                    require_maps_of(atlas, mapped)
                    quantities = _joined(atlas, mapped)
            title = text(self.scene.get("title", ""))
        # An axis with one value is no dimension but a number beside the data; the speed ratio always is one.
        single = {name: 0 for name in self.axes[:-1] if axes[name].size == 1}
        self._raw = xarray.Dataset(quantities, axes, {"title": title, "source": self.path}).isel(single)
        self._chosen = xarray.DataArray(self._raw["status"] == DONE)

    def _with(self, raw: xarray.Dataset, chosen: xarray.DataArray) -> Atlas:
        result = object.__new__(Atlas)
        result.__dict__.update(self.__dict__)
        result._raw, result._chosen = raw, chosen
        return result

    # --- what is there ---

    def __len__(self) -> int:
        """Points that are done and selected."""
        return int(self._chosen.sum())

    def __contains__(self, name: str) -> bool:
        return name in self._raw or name in self.scene.get("observables", [])

    def __repr__(self) -> str:
        grid = ", ".join(f"{name} {self._raw[name].size}" for name in self.axes if name in self._raw.dims)
        names = ", ".join(map(str, self._raw.data_vars))
        return f"<Atlas {self.path}: {counted(len(self), 'points')} of {grid or 'one'}; {names}>"

    def _repr_html_(self) -> str:
        return f"<p>{html.escape(repr(self))}</p>{self.dataset._repr_html_()}"

    @property
    def dataset(self) -> xarray.Dataset:
        """Everything with one value per point, masked."""
        return xarray.Dataset({name: self[str(name)] for name in self._raw.data_vars}, attrs=self._raw.attrs)

    @overload
    def __getitem__(self, name: str) -> xarray.DataArray: ...
    @overload
    def __getitem__(self, name: Mask) -> Atlas: ...

    def __getitem__(self, name: str | Mask) -> xarray.DataArray | Atlas:
        """One quantity, masked: NaN, or an empty word, where the point is not done or not selected. Of a mask, as
        `where`."""
        if not isinstance(name, str):
            return self.where(name)
        if name in self._raw.coords:
            return self._raw[name]
        if name not in self._raw:
            return self._rows(name)
        values = self._raw[name]
        words = words_of(values.attrs)
        if not words:
            return _flat(values, self._chosen)
        longest = max(map(len, words.values()))
        named = np.full(values.shape, "", dtype=f"U{longest}")
        for number, word in words.items():
            named[values.values == number] = word
        return values.copy(data=np.where(self._chosen.values, named, ""))

    def _rows(self, name: str) -> xarray.DataArray:
        """A quantity with several numbers per point, of the selected points only."""
        if name not in self.scene.get("observables", []):
            there = ", ".join([*map(str, self._raw.data_vars), *self._larger()])
            raise AtlasError(f"{name}: not in {self.path}, which has {there}")
        with AtlasFile(self.path) as atlas:
            dataset = atlas.dataset(name)
            inner = [dataset.dims[i][0].name.strip("/") for i in range(len(self.axes), dataset.ndim)]
            values, places = dataset, self._places(atlas)
            least = [min(place, default=0) for place in places]
            read = values[tuple(slice(low, max(place, default=-1) + 1) for low, place in zip(least, places))]
            read = read[np.ix_(*(place - low for low, place in zip(least, places)),
                               *(np.arange(size) for size in read.shape[len(places):]))]
            coordinates = {axis: atlas.axis(axis) for axis in inner}
            attributes = {"units": atlas.units(name), "long_name": atlas.long_name(name)}
        for axis, numbers in coordinates.items():
            if numbers.dtype.kind == "S":
                coordinates[axis] = np.char.decode(numbers)
        found = xarray.DataArray(read,
                                 {**{axis: np.atleast_1d(self._raw[axis].values) for axis in self.axes}, **coordinates},
                                 [*self.axes, *inner], name, attributes)
        gone = [axis for axis in self.axes if axis not in self._raw.dims]
        return _flat(found.squeeze(gone), self._chosen)

    def _larger(self) -> list[str]:
        return [name for name in self.scene.get("observables", []) if name not in self._raw]

    # --- choosing ---

    def _place(self, axis: str, wanted: Any, nearest: bool = False) -> Any:
        """Where a value, a list or a slice is on an axis; None where the selection has that value alone."""
        if axis in self.picked:
            value = DIRECTIONS.index(wanted) if axis == "direction" and wanted in DIRECTIONS else wanted
            if isinstance(value, slice) or not same_value(self.picked[axis], number_of(axis, value)):
                raise AtlasError(f"{axis} {wanted}: this selection has {self.picked[axis]:g} alone")
            return None
        values = self._axis(axis)
        if isinstance(wanted, slice):
            low = -np.inf if wanted.start is None else number_of(axis, wanted.start)
            high = np.inf if wanted.stop is None else number_of(axis, wanted.stop)
            return np.flatnonzero((values >= low) & (values <= high))
        if isinstance(wanted, (list, tuple, np.ndarray)):
            return [self._place(axis, one, nearest) for one in wanted]
        if axis == "direction" and wanted in DIRECTIONS:
            wanted = DIRECTIONS.index(wanted)
        wanted = number_of(axis, wanted)
        place = int(np.argmin(np.abs(values - wanted)))
        if nearest:
            if not values.min() <= wanted <= values.max():
                raise AtlasError(f"{axis} {wanted:g} is outside this atlas, which has {values.min():g} to "
                                 f"{values.max():g}")
        elif not same_value(values[place], wanted):
            few = ", ".join(format(value, "g") for value in values[max(0, place - 2):place + 3])
            nearby = "" if len(values) < 6 else "nearby "
            raise AtlasError(f"{axis} {wanted:g} is not in this atlas, which has {nearby}{few}; "
                             "method=\"nearest\" takes the nearest")
        return place

    def _axis(self, axis: str) -> np.ndarray[Any, Any]:
        """Values of an axis that has several here."""
        if axis not in self._raw.dims:
            raise AtlasError(f"{axis}: no axis of {self.path}, which has {', '.join(map(str, self._raw.dims))}")
        values: np.ndarray[Any, Any] = self._raw[axis].values
        return values

    def sel(self, *speed_ratio: Any, method: str | None = None, **wanted: Any) -> Atlas:
        """The points at values of axes: a number, a list of numbers, or a slice with both ends included.

        A value without a name is a speed ratio, here as in `orbit` and `plot.spectrum`: `sel(0.6)`. It must be one of
        the grid's, unless `method="nearest"` takes the nearest one.
        """
        if method not in (None, "nearest"):
            raise AtlasError(f"method {method!r}: None, or \"nearest\"")
        found = {axis: self._place(axis, value, method is not None)
                 for axis, value in _with_speed("sel", speed_ratio, wanted).items()}
        return self._at({axis: place for axis, place in found.items() if place is not None})

    def isel(self, *speed_ratio: Any, **wanted: Any) -> Atlas:
        """The points at places on axes, counted from 0: a whole number, a list, a slice, or a mask of the axis; what is
        without a name is a place on the speed ratio."""
        found = {}
        for axis, place in _with_speed("isel", speed_ratio, wanted).items():
            count = 1 if axis in self.picked else len(self._axis(axis))
            try:
                found[axis] = np.arange(count)[place]
            except (IndexError, TypeError, ValueError):
                raise AtlasError(f"{axis}: {place!r} is no place on an axis of {counted(count, 'values')}, "
                                 "counted from 0") from None
        return self._at({axis: place for axis, place in found.items() if axis not in self.picked})

    def _at(self, places: Mapping[str, Any]) -> Atlas:
        return self._with(self._raw.isel(places), self._chosen.isel(places))

    def line(self, **wanted: Any) -> Atlas:
        """All speeds at given values of other axes; an axis that is not given has the scene's own value."""
        for axis in self.picked.keys() & wanted.keys():
            self._place(axis, wanted[axis])  # refused where the selection has another value
        with AtlasFile(self.path) as atlas:
            line = atlas.line(**{**self.picked, **wanted})
            values: dict[str, Any] = {axis: float(line.value(axis)) for axis in self.axes[:-1]}
        return self.sel(**{axis: value for axis, value in values.items() if axis in self._raw.dims})

    @property
    def picked(self) -> dict[str, float]:
        """Axes other than the speed ratio that have one value here, with that value."""
        return {axis: float(self._raw[axis]) for axis in self.axes[:-1] if axis not in self._raw.dims}

    def where(self, condition: str | Mask) -> Atlas:
        """The points at which a condition holds, as text: "class = aperiodic and max displacement > 5 mm" (the grammar:
        `rubatlas.query`); or those of a mask such as `atlas["max_displacement"] > 5e-3`. In a text `lyapunov` is the
        largest exponent of each point."""
        if not isinstance(condition, str):
            return self._with(self._raw, self._chosen & self._mask(condition))

        def over_points(values: Any) -> query.Array:
            here = xarray.DataArray(values)
            found: query.Array = (here.broadcast_like(self._chosen).transpose(*self._chosen.dims) if here.ndim > 0
                                  else here).values
            return found

        names: dict[str, query.Name] = {}
        for name, values in self._raw.data_vars.items():
            words = words_of(values.attrs)
            names[str(name)] = query.Name(values.values, flags=words) if words else \
                query.Name(self[str(name)].values, values.attrs["units"])
        for name in FIRST_OF_ROW:
            if name in self._larger():
                row = self[name]
                names[name] = query.Name(row.values[..., 0], row.attrs["units"])
        for axis in self.axes:
            here = self._raw[axis]
            words = dict(enumerate(DIRECTIONS)) if axis == "direction" else None
            names[axis] = query.Name(over_points(here), here.attrs["units"], words)
        swept = {name: self._raw[name] for name in swept_pointers(self.scene)}
        sizes = {name: over_points(size) for name, size in sizes_of(with_values(self.scene, swept)).items()}
        holds = np.broadcast_to(query.evaluate(condition, names, sizes), self._chosen.shape)
        return self._with(self._raw, self._chosen & holds)

    def _mask(self, mask: Mask) -> np.ndarray[Any, np.dtype[np.bool_]]:
        """A mask in the shape of the selection; what a mask with axes of its own does not cover is not chosen."""
        if np.asarray(mask).dtype != bool:
            raise AtlasError(f"a mask is of true and false, not of {np.asarray(mask).dtype}")
        here = " × ".join(f"{name} {size}" for name, size in self._chosen.sizes.items())
        if isinstance(mask, xarray.DataArray):
            if not set(mask.dims) <= set(self._chosen.dims):
                raise AtlasError(f"a mask along {', '.join(map(str, mask.dims))}; this selection has {here}")
            mask = mask.reindex({name: self._chosen[name] for name in mask.dims}, fill_value=False)
            return np.asarray(mask.broadcast_like(self._chosen).transpose(*self._chosen.dims).values)
        if np.shape(mask) != self._chosen.shape:
            raise AtlasError(f"a mask of the shape {np.shape(mask)}; this selection has {here}")
        return np.asarray(mask)

    def points(self) -> Iterator[dict[str, Any]]:
        """Each selected point: its place on the axes and every quantity with one value per point."""
        data = self.dataset
        for place in np.argwhere(self._chosen.values):
            here = data.isel(dict(zip(self._chosen.dims, place)))
            yield {str(name): here[name].item() for name in [*self.axes, *data.data_vars]}

    @property
    def chosen_of_grid(self) -> np.ndarray[Any, np.dtype[np.bool_]]:
        """Which points of the whole grid are selected: what pictures show."""
        with AtlasFile(self.path) as atlas:
            return self._over_grid(atlas, self._chosen.values)

    def _places(self, atlas: AtlasFile) -> list[np.ndarray[Any, Any]]:
        """Where the values of each axis are on the axis of the file."""
        return [np.searchsorted(atlas.axis(axis), np.atleast_1d(self._raw[axis].values)) for axis in self.axes]

    def _over_grid(self, atlas: AtlasFile, chosen: np.ndarray[Any, Any]) -> np.ndarray[Any, np.dtype[np.bool_]]:
        """Points of this selection as points of the whole grid."""
        places = self._places(atlas)
        result = np.zeros([len(atlas.axis(axis)) for axis in self.axes], dtype=bool)
        result[np.ix_(*places)] = chosen.reshape([len(place) for place in places])
        return result

    # --- questions ---

    def bands(self) -> list[tuple[float, float]]:
        """From and to of each run of neighbouring speeds at which a selected point is, of one line."""
        several = [str(axis) for axis in self._chosen.dims if axis != "speed_ratio"]
        if several:
            raise AtlasError(f"bands: {', '.join(several)} still has several values; bands are those of one line, "
                             "which line(...) or sel(...) picks")
        with AtlasFile(self.path) as atlas:
            speed = atlas.axis("speed_ratio")
        chosen = self.chosen_of_grid.reshape(-1, len(speed)).any(axis=0)
        return [(float(speed[first]), float(speed[last])) for first, last in bands_of(chosen)]

    @property
    def contacts(self) -> xarray.DataArray:
        """Where blades touch the ring, one sentence for each line of the selection."""
        if self.maps_path is None:
            raise AtlasError(f"{self.path}: contacts are in the maps of the atlas, which `rubatlas analyse` makes")
        lines = self.axes[:-1]
        with AtlasFile(self.maps_path) as maps:
            sentences = np.char.decode(maps.dataset("table1/contact")[...], "utf-8")
            sentences = sentences.reshape([len(maps.axis(axis)) for axis in lines])
            sentences = sentences[np.ix_(*self._places(maps)[:-1])]
        found = xarray.DataArray(sentences, {axis: np.atleast_1d(self._raw[axis].values) for axis in lines}, lines)
        return found.squeeze([axis for axis in lines if axis not in self._raw.dims])

    @property
    def edges(self) -> xarray.Dataset | None:
        """Where motions change, narrowed down (`rubatlas edges`): of ATLAS_edges.h5 beside the atlas, else of the maps;
        None without either."""
        place = beside(self.path, "edges")
        if place is not None:
            with AtlasFile(self.path) as atlas:
                require_edges_of(atlas, place)
            return read_edges(str(place))
        if self.maps_path is not None:
            with AtlasFile(self.maps_path) as maps:
                there = "edges" in maps
            if there:
                return read_edges(self.maps_path)
        return None

    def safe_speeds(self, *keep: str, operate: float | str | None = None, aperiodic: bool = False,
                    least_width: float | str = 0.0, **limits: float | str) -> dict[str, Any]:
        """Bands of the speed ratio in which every line of the selection keeps the limits, and margins in percent.

        A speed at which a point of a line is not selected is in no band, and ends one as openly as the grid's end does.
        A name with a number limits the quantity from above, `max_displacement="3 mm"`, and a distance to danger
        (`margin`, `nearest_miss`, `lightest_touch`) from below; texts such as "class<=2" say which. A number without a
        unit is in the quantity's own. `operate`: a speed to judge, "540 rpm" or a speed ratio; `["operate"]["text"]`
        says in one sentence how far it is from danger. Aperiodic motions are not safe unless `aperiodic`, or a limit on
        the class, lets them be; a band has more than one speed, and `least_width`.
        """
        texts = [*keep, *(f"{name}{'>=' if name in MAY_NOT_OCCUR else '<='}{bound}" for name, bound in limits.items())]
        if not texts:
            raise AtlasError("safe_speeds: no limit is given; for example max_displacement=\"3 mm\"")
        with contextlib.ExitStack() as files:
            atlas = files.enter_context(AtlasFile(self.path))
            maps = files.enter_context(AtlasFile(self.maps_path)) if self.maps_path is not None else None
            speeds = np.arange(len(atlas.axis("speed_ratio")))
            # A point that is not done is not unselected: it is judged, as one that is not done.
            selected = self._over_grid(atlas, self._chosen.values | (self._raw["status"].values != DONE))
            judgement = Judgement(atlas, maps, texts, np.ix_(*self._places(atlas)[:-1], speeds), selected,
                                  aperiodic=aperiodic, least_width=least_width)
            result: dict[str, Any] = judgement.result(operate)
        return result

    @property
    def own_scene(self) -> dict[str, Any]:
        """The scene as it was written, without what it left to defaults."""
        with reading(self.path, "an atlas", "atlas") as file:
            written: dict[str, Any] = json.loads(text(file["scene"][()]))
        return written

    def orbit(self, speed_ratio: float, path: Path | None = None, method: str | None = None, **at: Any) -> OrbitFile:
        """The orbit of a point, with sections and the force on each blade: from `path`, else computed by the program.

        It is that of exactly this speed, with `method="nearest"` of the nearest one of the selection. At a speed of the
        grid it starts from the point's stored state, so that it shows the atlas' own motion; between the speeds from
        the scene's `initial`. With `path` it is kept there; a file of another motion is refused, not replaced.
        """
        if method is not None:
            point = self.sel(speed_ratio, method=method, **at)
            speed_ratio, at = point["speed_ratio"].item(), {axis: point[axis].item() for axis in at}
        at = {**self.picked, **at}
        with AtlasFile(self.path) as atlas:
            unknown = [axis for axis in at if axis not in atlas.axes]
            if unknown:
                raise AtlasError(f"orbit: no axis {', '.join(unknown)}; {self.path} has {', '.join(atlas.axes)}")
            usual = atlas.line()
            values = {axis: number_of(axis, at.get(axis, usual.value(axis)))
                      for axis in atlas.axes[:-1] if axis != "direction"}
            swept = {"direction": at.get("direction", 0)} if "direction" in atlas.axes else {}
            values["speed_ratio"] = number_of("speed_ratio", speed_ratio)
            stored = all(np.isclose(atlas.axis(axis), value, rtol=1e-9, atol=0.0).any()
                         for axis, value in values.items())
            if stored:
                place = np.argmin(abs(atlas.axis("speed_ratio") - values["speed_ratio"]))
                line = atlas.line(**{axis: value for axis, value in values.items() if axis != "speed_ratio"}, **swept)
                values["speed_ratio"], start = float(atlas.axis("speed_ratio")[place]), line.raw("final_state")[place]
                swept = {axis: DIRECTIONS[int(line.value(axis))] for axis in swept}
        if path is not None and os.path.exists(path):
            found = OrbitFile(path)
            differing = [axis for axis, value in values.items() if not same_value(found.attributes[axis], value)]
            if differing:
                raise AtlasError(f"{path}: an orbit at another {differing[0].replace('_', ' ')}, "
                                 f"{float(found.attributes[differing[0]]):g}; choose another path")
            require_same(self.path, with_values(self.scene, found.attributes), path, found.scene)
            if stored and not np.array_equal(found.attributes["start"], start):
                raise AtlasError(f"{path}: an orbit from another state at these values; choose another path")
            return found
        named = ",".join(f"{axis}={value!r}" for axis, value in values.items())
        if stored:
            named += "".join(f",{axis}={word}" for axis, word in swept.items())
        with tempfile.TemporaryDirectory() as folder, scene_file(self.own_scene) as scene:
            target = pathlib.Path(folder) / "orbit.h5" if path is None else pathlib.Path(path)
            command("orbit", scene, output=target, program=self.program, at=named, from_=self.path if stored else None)
            return OrbitFile(target, f"the orbit at {named}")

    @property
    def plot(self) -> Plots:
        """Pictures as methods that draw into axes and return them: `atlas.plot.bifurcation(damping_ratio=0.1)`."""
        return Plots(self)


def open(  # noqa: A001  # pylint: disable=redefined-builtin
        path: Path, maps: Path | None = None, program: Path | None = None) -> Atlas:
    """An atlas, with the maps beside it (ATLAS_maps.h5) or those that are named."""
    return Atlas(path, maps, program)

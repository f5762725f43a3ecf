"""Pictures as methods of an atlas. Each draws into one matplotlib axes, its own or the caller's, and returns it:

    figure, (left, right) = plt.subplots(1, 2)
    atlas.plot.bifurcation(ax=left, damping_ratio=0.1)
    atlas.plot.map(ax=right)
"""
from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Any, Protocol

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import xarray
from matplotlib.axes import Axes

from rubatlas import style
from rubatlas.atlas_file import AtlasError, AtlasFile, number_of, same_value, words_of
from rubatlas.plots import bifurcation, blade, displacement, margin, orbit, spectrum, waterfall
from rubatlas.plots import map as map_of


class Selection(Protocol):
    """What a picture needs of the `Atlas` that it is drawn from."""

    path: str
    maps_path: str | None

    @property
    def dataset(self) -> xarray.Dataset: ...
    @property
    def picked(self) -> dict[str, float]: ...
    @property
    def chosen_of_grid(self) -> np.ndarray[Any, np.dtype[np.bool_]]: ...
    def sel(self, *speed_ratio: Any, method: str | None = None, **wanted: Any) -> Selection: ...
    def orbit(self, speed_ratio: float, path: None = None, method: str | None = None,
              **at: Any) -> orbit.OrbitFile: ...


@contextlib.contextmanager
def _panel(ax: Axes | None) -> Iterator[Axes]:
    """The caller's axes, or new ones as our pictures have them."""
    if ax is not None and not isinstance(ax, Axes):
        raise AtlasError(f"{ax!r}: no axes of matplotlib, which come first; all else has a name, as in quantity=...")
    with matplotlib.rc_context(style.SETTINGS):
        yield plt.subplots()[1] if ax is None else ax


class Plots:
    """`atlas.plot`. Values of axes pick the line: `damping_ratio=0.1`; an axis that is not given has the value that was
    selected, else the scene's own. Points that `sel` or `where` has not chosen stay blank."""

    def __init__(self, atlas: Selection) -> None:
        self._atlas = atlas

    @contextlib.contextmanager
    def _maps(self) -> Iterator[AtlasFile]:
        if self._atlas.maps_path is None:
            raise AtlasError(f"{self._atlas.path}: this picture needs the atlas' maps; `rubatlas analyse` makes them, "
                             "open(maps=...) names them")
        with AtlasFile(self._atlas.maps_path) as maps:
            yield maps

    def _file(self) -> AtlasFile:
        return AtlasFile(self._atlas.path, self._atlas.chosen_of_grid)

    def _picked(self, line: dict[str, Any]) -> dict[str, Any]:
        """Values of axes that pick the line: those of the selection, and those that are asked for."""
        picked = self._atlas.picked
        for axis, value in line.items():
            if axis in picked and axis != "direction" and not same_value(picked[axis], number_of(axis, value)):
                raise AtlasError(f"{axis} {value}: this selection has {picked[axis]:g} alone")
        return {**picked, **line}

    def _finished(self, panel: Axes, ax: Axes | None) -> Axes:
        """The panel, with its limits at the selected speeds where these are fewer than the grid's; and with an axis in
        rpm where the picture is our own."""
        speeds = np.atleast_1d(self._atlas.dataset["speed_ratio"].values)
        with self._file() as atlas:
            if len(speeds) < len(atlas.axis("speed_ratio")) and len(speeds) > 1:
                panel.set_xlim(speeds[0], speeds[-1])
            if ax is None:
                style.rpm_axis(panel, atlas.sizes())
        return panel

    def bifurcation(self, ax: Axes | None = None, component: str = "x", **line: Any) -> Axes:
        """x or y at the sections, one dot for each revolution, over the speed ratio."""
        line = self._picked(line)
        with _panel(ax) as panel, self._file() as atlas:
            bifurcation.into(panel, atlas.line(**line), component)
            return self._finished(panel, ax)

    def waterfall(self, ax: Axes | None = None, max_frequency: float | None = None, **line: Any) -> Axes:
        """The spectrum over frequency and speed ratio."""
        line = self._picked(line)
        with _panel(ax) as panel, self._file() as atlas:
            image, _ = waterfall.into(panel, atlas.line(**line), max_frequency)
            style.colour_bar(image, waterfall.bar_label(atlas), ax=panel, pad=0.02)
            return panel

    def displacement(self, ax: Axes | None = None, along: str | None = None, **line: Any) -> Axes:
        """Maximum displacement over the clearance, one curve for each value of a parameter."""
        line = self._picked(line)
        with _panel(ax) as panel, self._file() as atlas:
            displacement.into(panel, atlas, displacement.along_of(atlas, along, line), line)
            return self._finished(panel, ax)

    def map(self, ax: Axes | None = None, quantity: str = "max_displacement", along: str | None = None,
            **line: Any) -> Axes:
        """A quantity, or "class", over the speed ratio and a parameter."""
        line = self._picked(line)
        with _panel(ax) as panel, self._file() as atlas:
            along = displacement.along_of(atlas, along, line)
            if quantity in ("class", "class_blade_passing"):
                with self._maps() as maps:
                    handles = map_of.classes_into(panel, atlas, maps, along, line, quantity != "class")
                panel.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.0, 1.0))
            elif quantity not in atlas and (quantity.startswith("margin") or quantity in self._atlas.dataset):
                raise AtlasError(f"{quantity}: of the maps of the atlas, of which plot.map draws class and "
                                 "class_blade_passing, and plot.margin the margins")
            elif words_of(atlas.dataset(quantity).attrs):
                raise AtlasError(f"{quantity}: words, not numbers; a map draws class, class_blade_passing or a "
                                 "quantity of numbers")
            else:
                image, _ = map_of.into(panel, atlas, along, line, quantity)
                label = f"{quantity.replace('_', ' ')} [{style.drawn(atlas.units(quantity))[0]}]"
                style.colour_bar(image, label, ax=panel, pad=0.02)
            return self._finished(panel, ax)

    def margin(self, ax: Axes | None = None, name: str = "speed_ratio", along: str | None = None, **line: Any) -> Axes:
        """Distance to the nearest change of motion, or ("speed_ratio_to_grazing") to the predicted grazing."""
        line = self._picked(line)
        with _panel(ax) as panel, self._file() as atlas, self._maps() as maps:
            image, _ = margin.into(panel, atlas, maps, displacement.along_of(atlas, along, line), line, name)
            style.colour_bar(image, margin.label(maps, name), ax=panel, pad=0.02)
            return self._finished(panel, ax)

    def spectrum(self, speed_ratio: float, ax: Axes | None = None, method: str | None = None, **line: Any) -> Axes:
        """The spectrum of a point of the grid; with `method="nearest"` of the one that is nearest in speed."""
        line = self._picked(line)
        speed_ratio = self._atlas.sel(speed_ratio, method=method).dataset["speed_ratio"].item()
        with _panel(ax) as panel, self._file() as atlas:
            spectrum.into(panel, atlas.line(**line), speed_ratio)
            return panel

    def blade(self, ax: Axes | None = None, what: str = "shortening", **line: Any) -> Axes:
        """Shortening or deflection of a blade over its load."""
        line = self._picked(line)
        with _panel(ax) as panel, self._file() as atlas:
            blade.into(panel, atlas.line(**line), what, every_friction="friction" not in line)
            return panel

    def orbit(self, speed_ratio: float, ax: Axes | None = None, method: str | None = None, **at: Any) -> Axes:
        """The orbit of a point, which the program computes, with its sections and the clearance circle."""
        computed = self._atlas.orbit(speed_ratio, method=method, **at)
        with _panel(ax) as panel:
            orbit.plane_into(panel, computed)
            return panel

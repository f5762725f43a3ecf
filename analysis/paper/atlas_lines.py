"""The lines of an atlas, with what `rubatlas analyse` has found on them (MAPS.h5)."""
import functools
import types
from collections.abc import Iterator

import h5py
import numpy as np
from rubatlas.atlas_file import AtlasError, AtlasFile, beside
from rubatlas.same_scene import require_maps_of

from paper.line import Line, Numbers, Region, Trigger

# How quantities are written in texts; others go by the names of their axes.
SYMBOLS = {"damping_ratio": "ζ", "friction": "μ", "unbalance": "me", "thickness": "h", "ring_stiffness": "kr",
           "unbalance_phase": "γ", "rotor_mass": "m", "rotor_misalignment": "y0", "ring_radius": "R"}


def _region(speed: Numbers, presence: int, start: float, end: float, share: float, peak: float, median: float,
            open_ends: int) -> Region:
    """Where an end lies at the end of the grid, it is cut off there."""
    cut_off = (1 if start == speed[0] else 0) | (2 if end == speed[-1] else 0)
    return Region(presence, start, end, share, peak, median, int(open_ends), cut_off & int(open_ends))


class AtlasLines:
    """An open atlas and its maps, line by line."""

    def __init__(self, atlas: str, maps: str | None = None) -> None:
        self._atlas = AtlasFile(atlas)
        place = maps or beside(atlas, "maps")
        if place is None:
            raise AtlasError(f"{atlas}: no maps beside it; `rubatlas analyse` makes them")
        self._maps = AtlasFile(place)
        require_maps_of(self._atlas, self._maps)
        if "table1" not in self._maps:
            raise AtlasError(f"{place}: no /table1; these are no maps of `rubatlas analyse`")
        self.path = atlas
        self.scene: dict = self._maps.scene
        self.names: list[str] = self._maps.axes[:-1]  # of the axes but the speed
        self.values = {name: self._maps.axis(name) for name in self.names}
        self._units = {name: self._maps.units(name) for name in self.names}

    def __enter__(self) -> "AtlasLines":
        return self

    def __exit__(self, *_: object) -> None:
        self._atlas.__exit__(None, None, None)
        self._maps.__exit__(None, None, None)

    @property
    def starts(self) -> bool:
        """Whether the initial state is an axis: its lines have no regions."""
        return any(name.startswith("initial_") and values.size > 1 for name, values in self.values.items())

    def text(self, name: str, value: float) -> str:
        """"ζ = 0.1", "direction = up"."""
        if name == "direction":
            return f"direction = {'down' if value else 'up'}"
        factor, unit = {"m": (1e3, " mm"), "-": (1.0, "")}.get(self._units[name], (1.0, f" {self._units[name]}"))
        return f"{SYMBOLS.get(name, name)} = {factor * value:.6g}{unit}"

    @functools.cached_property
    def lines(self) -> list[Line]:
        """All, in the order of the file."""
        return list(self._read())

    def _read(self) -> Iterator[Line]:
        maps, table = self._maps.file, self._maps.file["table1"]
        speed, count = maps["speed_ratio"][...], table["line"].size
        column = {name: values[...] for name, values in table.items() if values.dtype.kind in "fu"}

        def of_lines(name: str) -> np.ndarray:
            return maps[name][...].reshape(count, speed.size) if name in maps else np.full((count, speed.size), np.nan)
        motion, displacement = of_lines("class"), of_lines("max_displacement")
        contact = of_lines("contact") if "contact" in maps else None
        doublings = self._doublings(count)
        map_of_doublings = "blade passings" if "class_blade_passing" in maps else "revolutions"
        signs = {name: values[...] for name, values in maps.get("signature", {}).items() if values.dtype.kind in "fiu"}
        shape = [values.size for values in self.values.values()]
        for i in range(count):
            place = np.unravel_index(i, shape)
            yield Line(
                speed=speed, motion=motion[i], displacement=displacement[i],
                regions=[_region(speed, *(column[f"region_{k}_{name}"][i] for name in
                                          ("presence", "from", "to", "aperiodic_share", "peak_displacement",
                                           "median_displacement", "open"))) for k in (1, 2, 3, 4)],
                triggers=[Trigger(*(column[f"trigger_{k}_{name}"][i] for name in
                                    ("presence", "speed_ratio", "rise", "ratio"))) for k in (1, 2)],
                doublings=doublings[i], doublings_in=map_of_doublings, blades=int(self.scene["blades"]["count"]),
                parameters=types.MappingProxyType({name: float(values[at]) for (name, values), at in
                                                   zip(self.values.items(), place)}),
                contact=None if contact is None else contact[i],
                signs={name: float(values[i]) for name, values in signs.items()},
                rows=functools.partial(self._rows, tuple(int(at) for at in place)))

    def _rows(self, place: tuple[int, ...], name: str) -> Numbers | None:
        """Rows of an observable on one line; NaN where a point is not done."""
        if name not in self._atlas:
            return None
        dataset = self._atlas.dataset(name)
        if not isinstance(dataset, h5py.Dataset):
            return None
        values = dataset[place].astype(float)
        values[self._atlas.dataset("status")[place] != 1] = np.nan
        return values

    def _doublings(self, count: int) -> list[list[tuple[float, int]]]:
        found: list[list[tuple[float, int]]] = [[] for _ in range(count)]
        if "doublings" in self._maps:
            group = self._maps.file["doublings"]
            for line, speed, period in zip(group["line"][...], group["at_speed_ratio"][...], group["period"][...]):
                found[int(line)].append((float(speed), int(period)))
        return found

    def swept_values(self, pointer: str) -> np.ndarray | None:
        """Values of a quantity that the grid sweeps with several values; None where it does not."""
        axis = axis_of(pointer)
        return self.values[axis] if axis in self.values and self.values[axis].size > 1 else None

    @property
    def has_spectra(self) -> bool:
        return "spectrum" in self._atlas

    def orders(self) -> Numbers:
        """Orders of /spectrum."""
        return self._atlas.axis("order")


# Axes with names of their own; another is named by its pointer, with _ for /.
OWN_AXES = {"/rotor/damping_ratio": "damping_ratio", "/contact/friction": "friction",
            "/unbalance/moment": "unbalance", "/blades/thickness": "thickness"}


def axis_of(pointer: str) -> str:
    return OWN_AXES.get(pointer, pointer.strip("/").replace("/", "_"))

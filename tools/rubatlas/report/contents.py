"""What of an atlas goes into a report: texts and tables as JSON, numbers as compressed blocks.

Numbers that are only drawn are float32; states from which the page computes on are float64. Sections and spectra come
line by line, so that a page opens without unpacking all of them, and as many sections as the size of the file allows.
Where the page cannot compute, orbits of some points that the program computes are part of it.
"""
import json
import math
import os

import numpy as np

from rubatlas.atlas_file import (DONE, FIRST_OF_ROW, SCENE_VALUE, SYMBOL, AtlasError, printable, swept_pointers,
                                 with_values, words_of)
from rubatlas.elastica import angles_from_tip
from rubatlas.report.blocks import Blocks
from rubatlas.report.orbits import orbits_of
from rubatlas.same_scene import require_maps_of

# In the order in which the program remembers them.
EFFECTS_THAT_REMEMBER = ("wear", "ring_body")
# Bytes of all blocks; with the page's own half megabyte and the solver the file stays below 20 MB.
MOST_BYTES = 17_000_000
# Maps of an atlas with more points are single precision.
MOST_POINTS_IN_FULL = 30_000
# Spectral lines are gathered into bins this many orders wide, the first width with which the spectra take no more than
# half of the bytes; a bin holds the largest of its lines.
WIDTHS_OF_BINS = (0.02, 0.05, 0.1, 0.25)
# So many orbits the program computes for a page that computes none: some tenths of a second each.
ORBITS = 200
# The table that the page draws blades from ends above the angle [rad] and the length of a blade that is shortened by
# its whole length. Angles are closest where a blade begins to buckle.
LAST_OF_SHAPES, ANGLES_OF_SHAPES, LENGTHS_OF_SHAPES = 3.0, 120, 30
# Amplitudes are kept as 16 bits of their logarithm over this range below the largest of the atlas.
DECADES_OF_SPECTRUM = 8.0


def number(value):
    """A number as JSON has it: none for NaN and infinity."""
    value = float(value)
    return value if math.isfinite(value) else None


def flags_of(dataset):
    """Words of a dataset whose values are flags, by value as JSON has it; none where they are numbers."""
    return {str(value): word for value, word in words_of(dataset.attrs).items()} or None


# --- axes and maps ---

def axes_of(atlas):
    pointers: dict[str, tuple[str, str] | None] = {**SCENE_VALUE, "speed_ratio": None, **swept_pointers(atlas.scene)}
    result = []
    for name in atlas.axes:
        values = atlas.axis(name)
        result.append({"name": name, "symbol": SYMBOL.get(name, ""), "units": atlas.units(name),
                       "long_name": atlas.long_name(name),
                       "values": [float(value) for value in values], "pointer": pointers.get(name)})
    return result


def maps_of(atlas, maps, blocks):
    """Everything with one number per point: what a map can show, a query can ask and a point's facts list."""
    shape = atlas.dataset("status").shape
    done = atlas.dataset("status")[...] == DONE
    result = []

    def add(name, source, dataset, values, long_name=None, masked=True):
        flags = flags_of(dataset)
        if flags is None:
            values = np.where(done, values, np.nan) if masked else values
            values = values.astype("<f8" if values.size <= MOST_POINTS_IN_FULL else "<f4")
        else:
            values = values.astype("u1")
        result.append({"name": name, "units": source.units(dataset.name),
                       "long_name": long_name or source.long_name(dataset.name),
                       "flags": flags, **blocks.add(name, values.ravel())})

    if maps is not None:
        for name in ("class", "class_blade_passing", "contact"):
            if name in maps:
                add(name, maps, maps.dataset(name), maps.dataset(name)[...])
        if "attractor" in maps:
            add("attractor", maps, maps.dataset("attractor"), maps.dataset("attractor")[...].astype(float))
    for name in ("status", "status_detail"):
        if name in atlas:
            add(name, atlas, atlas.dataset(name), atlas.dataset(name)[...])
    for name in sorted(atlas.scene.get("observables", [])):
        dataset = atlas.dataset(name)
        if dataset.shape == shape:
            add(name, atlas, dataset, dataset[...])
        elif name in FIRST_OF_ROW:
            add(name, atlas, dataset, dataset[..., 0], FIRST_OF_ROW[name])
    if "restarted" in atlas:
        add("restarted", atlas, atlas.dataset("restarted"), atlas.dataset("restarted")[...])
    if maps is not None and "margins" in maps:
        for name in sorted(maps.file["margins"]):
            dataset = maps.file["margins"][name]
            if dataset.shape == shape:
                # The distance along the speed is called margin alone, as in the limits of safe speeds.
                name = name.removeprefix("along_")
                add("margin" if name == "speed_ratio" else f"margin_{name}", maps, dataset, dataset[...])
    return result


# --- lines ---

def lines_of(atlas, blocks):
    """Poincaré sections (x, y of the last ones) and spectra, a block for each line of the atlas."""
    done = atlas.dataset("status")[...] == DONE
    count = int(np.prod(done.shape[:-1]))
    speeds = done.shape[-1]
    result: dict[str, dict | None] = {"poincare": None, "spectrum": None}
    if "spectrum" in atlas.scene.get("observables", []):
        result["spectrum"] = spectra(atlas, blocks, done.reshape(count, speeds))
    if "poincare" in atlas.scene.get("observables", []):
        dataset = atlas.dataset("poincare")
        kept = dataset.shape[-2]
        while True:
            trial = Blocks()
            lines = []
            for line in range(count):
                index = np.unravel_index(line, done.shape[:-1])
                values = dataset[index][:, -kept:, :2].astype("<f4")
                values[~done[index]] = np.nan
                lines.append(trial.add(f"poincare/{line}", values))
                if trial.size + blocks.size > MOST_BYTES:
                    break
            if trial.size + blocks.size <= MOST_BYTES or kept == 1:
                break
            kept = max(1, kept // 2)
        if trial.size + blocks.size <= MOST_BYTES:
            blocks.texts.update(trial.texts)
            result["poincare"] = {"sections": kept, "of": int(dataset.shape[-2]), "lines": lines}
    return result


def spectra(atlas, blocks, done):
    for width in WIDTHS_OF_BINS:
        trial = Blocks()
        result = binned_spectra(atlas, trial, done, width)
        if trial.size <= 0.5 * (MOST_BYTES - blocks.size):
            blocks.texts.update(trial.texts)
            return result
    return None


def binned_spectra(atlas, blocks, done, width):
    orders = atlas.axis("order")
    dataset = atlas.dataset("spectrum")
    bins = np.floor(orders / width + 0.5).astype(int)
    starts = np.flatnonzero(np.diff(bins, prepend=-1))
    count = len(done)
    lines = []
    binned = np.empty((count, done.shape[1], len(starts)), dtype="f4")
    for line in range(count):
        values = dataset[np.unravel_index(line, atlas.dataset("status").shape[:-1])]
        values = np.where(done[line][:, None], values, 0.0)
        binned[line] = np.maximum.reduceat(values, starts, axis=1)
    largest = float(binned.max(initial=0.0))
    if not largest > 0.0:
        return None
    decades = np.log10(np.maximum(binned / largest, 10.0**-DECADES_OF_SPECTRUM)) + DECADES_OF_SPECTRUM
    codes = np.round(decades / DECADES_OF_SPECTRUM * 65535.0).astype("<u2")
    for line in range(count):
        lines.append(blocks.add(f"spectrum/{line}", codes[line]))
    return {"orders": [float(order) for order in bins[starts] * width], "lines": lines, "largest": largest,
            "decades": DECADES_OF_SPECTRUM, "units": atlas.units("spectrum")}


def shapes_of_blades():
    """What the page draws blades in contact from."""
    tips = LAST_OF_SHAPES * np.linspace(0.0, 1.0, ANGLES_OF_SHAPES + 1) ** 2
    lengths = np.linspace(0.0, LAST_OF_SHAPES, LENGTHS_OF_SHAPES + 1)
    return {"step": float(lengths[1]), "angles": np.round(angles_from_tip(tips, lengths), 6).tolist()}


# --- words ---

def group(maps, name):
    """The columns of a table of the maps, as lists."""
    if maps is None or name not in maps.file:
        return None
    columns = {}
    for key, dataset in maps.file[name].items():
        values = dataset[...]
        flags = flags_of(dataset)
        if values.dtype.kind in "SO":
            columns[key] = [printable(value) for value in values]
        elif flags is not None:
            columns[key] = [flags.get(str(int(value)), str(int(value))) for value in values]
        else:
            columns[key] = [number(value) for value in values]
    return columns


def runs_beside(path):
    """What the program has written of its runs beside the atlas; nothing where that is not there or not readable."""
    try:
        with open(f"{path}.run.json", encoding="utf-8") as file:
            runs = json.load(file)["runs"]
        return [{key: run.get(key)
                 for key in ("started", "finished", "processor", "ranks", "points_computed", "wall_seconds")}
                for run in runs]
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return []


def why_not_computed(solver):
    """Why the page computes no points of its own; empty where it does."""
    if solver is None:
        return ("This report was made without the solver, which `cmake --build build --target rubatlas_wasm` makes and "
                "--solver names.")
    return ""


def add_orbits(result, blocks, atlas, count):
    """Orbits that the program computes: `count` of them; where that is None, those of a page that computes none."""
    wanted = count if count is not None else ORBITS if result["not_computed"] else 0
    if wanted == 0:
        return
    try:
        result["orbits"] = orbits_of(atlas, wanted, 0.6 * (MOST_BYTES - blocks.size), blocks)
    except AtlasError as error:
        if count is not None:
            raise
        result["no_orbits"] = str(error)


def remembered(atlas):
    """What effects remember at the end of each point, one row a point."""
    names = [f"final_state_{effect}" for effect in EFFECTS_THAT_REMEMBER if f"final_state_{effect}" in atlas]
    count = atlas.dataset("status").size
    return np.hstack([np.empty((count, 0)), *(atlas.dataset(name)[...].reshape(count, -1) for name in names)])


def contents(atlas, maps, solver, orbits=None):
    """The JSON of a report, and its blocks. `solver`: bytes of the WebAssembly module, or none. `orbits`: see
    `add_orbits`."""
    if maps is not None:
        require_maps_of(atlas, maps)
    blocks = Blocks()
    status = atlas.dataset("status")[...]
    meanings = flags_of(atlas.dataset("status"))
    memory = remembered(atlas)
    result = {
        "title": printable(atlas.scene.get("title") or os.path.basename(atlas.path)),
        "reference": printable(atlas.scene.get("reference", "")),
        "file": os.path.basename(atlas.path),
        "maps_file": os.path.basename(maps.path) if maps is not None else None,
        "scene": with_values(atlas.scene, {name: atlas.own_value(name) for name in swept_pointers(atlas.scene)}),
        "axes": axes_of(atlas),
        "maps": maps_of(atlas, maps, blocks),
        "final_state": blocks.add("final_state", atlas.dataset("final_state")[...].astype("<f8").reshape(-1)),
        "final_memory": blocks.add("final_memory", memory.astype("<f8").reshape(-1)),
        "remembered": memory.shape[1],
        "points": {word: int((status == int(value)).sum()) for value, word in meanings.items()},
        "table1": group(maps, "table1"),
        "effects": group(maps, "effects"),
        "provenance": {name: atlas.attribute(name)
                       for name in ("software", "software_version", "git_commit", "compiler", "schema_version")},
        "runs": runs_beside(atlas.path),
        "elastica": shapes_of_blades(),
        "not_computed": why_not_computed(solver),
        "orbits": [],
        "no_orbits": "",
    }
    if blocks.size > MOST_BYTES:
        raise AtlasError(f"{atlas.path}: {status.size} points are too many for one page; a report holds some hundred "
                         "thousand")
    add_orbits(result, blocks, atlas, orbits)
    result["lines"] = lines_of(atlas, blocks)
    if not result["not_computed"]:
        blocks.keep("solver", solver)
    return result, blocks

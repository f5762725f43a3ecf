"""Orbits for pages that cannot compute them: the program computes them while a report is made."""
import concurrent.futures
import os
import sys
from typing import Any

import numpy as np

from rubatlas.atlas_file import DONE, AtlasError
from rubatlas.program import find_program
from rubatlas.report.blocks import Blocks

# What a page shows of an orbit: its last revolutions, with at least so many samples in each.
REVOLUTIONS = 8
SAMPLES = 128


def spread(points, count):
    """At most `count` of the points, evenly spread over them."""
    points = np.asarray(points)
    if len(points) <= count:
        return points
    return points[np.unique(np.linspace(0, len(points) - 1, count).round().astype(int))]


def shown_part(orbit):
    """The last revolutions of an orbit as one array of single precision, and how the page takes it apart.

    In this order: state (sample, 4), force (sample, blade), then number, blade, time in revolutions and force of each
    sample of a contact.
    """
    time, state, force = (orbit.data[name] for name in ("time", "state", "force"))
    revolutions = min(REVOLUTIONS, len(orbit.data["sections"]))
    each = len(time) // len(orbit.data["sections"])
    stride = max(1, each // SAMPLES) if each % SAMPLES == 0 else 1
    first = len(time) - revolutions * each
    inside = orbit.data["contact_time"] >= time[first]
    contact = {name: orbit.data[f"contact_{name}"][inside] for name in ("number", "blade", "time", "force")}
    numbers = np.unique(contact["number"], return_inverse=True)[1]
    # Samples are equal parts of a revolution, also where a ramp makes one shorter than the other.
    turned = np.interp(contact["time"], np.append(time, 2.0 * time[-1] - time[-2]),
                       np.arange(len(time) + 1) / each) - first / each
    columns = [state[first::stride], force[first::stride], numbers, contact["blade"] - 1, turned, contact["force"]]
    flat = np.concatenate([np.ravel(column) for column in columns]).astype("<f4")
    return flat, {"samples": each // stride, "times": revolutions * (each // stride), "blades": force.shape[1],
                  "contact_samples": len(numbers)}


def orbits_of(atlas, count, most_bytes, blocks):
    """Orbits of at most `count` points of an atlas, as blocks that take at most `most_bytes`; none where no point is
    done."""
    # Only here: most reports hold no orbits, and xarray takes a second to be imported.
    from rubatlas.atlas import Atlas  # pylint: disable=import-outside-toplevel
    status = atlas.dataset("status")[...]
    points = spread(np.flatnonzero(status == DONE), count)
    source = Atlas(atlas.path)

    def computed(point):
        index = np.unravel_index(point, status.shape)
        values: dict[str, Any] = {name: float(atlas.axis(name)[place]) for name, place in zip(atlas.axes, index)}
        try:
            return shown_part(source.orbit(**values))
        except AtlasError:
            return None  # the motion goes on from the point's last state, and may leave the model then

    find_program()  # without it none is computed, and the error says why
    found = []
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as threads:
        for number, (point, part) in enumerate(zip(points, threads.map(computed, points)), 1):
            if part is not None:
                numbers, shape = part
                trial = Blocks()
                found.append((trial, {"point": int(point), **shape, **trial.add(f"orbit/{point}", numbers)}))
            if sys.stderr.isatty():
                print(f"\rorbit {number} of {len(points)}", end="" if number < len(points) else "\n", file=sys.stderr,
                      flush=True)
    while found and sum(trial.size for trial, _ in found) > most_bytes:
        found = found[1::2]
    for trial, _ in found:
        blocks.texts.update(trial.texts)
    return [entry for _, entry in found]

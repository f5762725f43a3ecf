#!/usr/bin/python3
"""Compares what two builds of the program, or two methods, compute for all scenes of jobs/, and prints a table.

    /usr/bin/python3 tests/bench/compare_builds.py OLD NEW [--speeds 9] [--revolutions 140] [SCENE.json...]

OLD and NEW are two programs `rubatlas`, each with a method of integration where one is named: build/rubatlas=hybrid.
Each scene is thinned out: that many speed ratios of its range, the first and the last value of every other axis, that
many revolutions, of which the last two sevenths are sampled. Columns: points; points whose sections agree byte by byte;
points whose status differs; points whose class of motion differs, as `analyse` of NEW has it; the largest distance of
the sets of sections of points that are periodic in both, in units of accuracy.tolerance times the clearance; and how
many times as fast NEW is, by the processor time that its ranks have spent on points. A scene that one of the two
refuses, since it does not know an effect of it, has a row without numbers.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
LONGEST_PERIOD = 16  # classes 1 ... 16 are periods


def values(axis):
    """The values of a grid's axis: a number, a list, or from/to/count."""
    if isinstance(axis, dict):
        return np.linspace(axis["from"], axis["to"], axis["count"])
    return np.atleast_1d(axis)


def thinned(scene, speeds, revolutions):
    grid = {name: [float(value) for value in values(axis)] for name, axis in scene["grid"].items()}
    for name, axis in grid.items():
        kept = np.linspace(0, len(axis) - 1, min(len(axis), speeds if name == "speed_ratio" else 2))
        chosen = [axis[round(index)] for index in kept]
        grid[name] = [round(value, 6) for value in chosen] if name == "speed_ratio" else chosen
    observables = ["poincare", "max_displacement"]
    sampled = 2 * revolutions // 7
    protocol = {**scene.get("protocol", {}), "transient_revolutions": revolutions - sampled,
                "sampled_revolutions": sampled}
    return {**scene, "grid": grid, "observables": observables, "protocol": protocol}


class Refused(Exception):
    """A program does not know what a scene says."""


def call(*command):
    job = subprocess.run(command, capture_output=True, text=True, check=False)
    if job.returncode == 2:
        raise Refused(job.stderr)
    if job.returncode not in (0, 1, 10):  # some points without a motion
        sys.exit(f"{' '.join(map(str, command))} ended with {job.returncode}: {job.stderr.strip()}")


class Side:
    """A program, and the method that it is to take."""

    def __init__(self, text):
        program, _, method = text.partition("=")
        self.program = pathlib.Path(program).resolve()
        self.accuracy = {"method": method} if method else {}

    def atlas_of(self, scene, atlas):
        scene = {**scene, "accuracy": {**scene.get("accuracy", {}), **self.accuracy}}
        path = atlas.with_suffix(".json")
        path.write_text(json.dumps(scene))
        call(self.program, "run", path, "-o", atlas, "--progress", "off")
        runs = json.loads(pathlib.Path(f"{atlas}.run.json").read_text())["runs"]
        seconds = sum(sum(run["busy_seconds_of_rank"]) for run in runs)
        with h5py.File(atlas) as file:
            resolved = json.loads(file["scene_resolved"][()])
            return file["status"][...], file["poincare"][...], resolved, seconds


def classes_of(program, atlas, maps):
    call(program, "analyse", atlas, "-o", maps)
    with h5py.File(maps) as file:
        return file["class"][...]


def clearance_scale(scene):
    ring, blades = scene["ring"], scene["blades"]
    clearance = ring["radius"] - blades["hub_radius"] - blades["length"]
    return clearance if clearance > 0 else 0.1 * blades["length"]


def distance(old, new):
    """Of two sets of sections: a transient decides in which of its phases a motion of several revolutions is met."""
    apart = np.abs(old[:, None, :] - new[None, :, :]).max(axis=-1)
    return max(apart.min(axis=0).max(), apart.min(axis=1).max())


def compare(old, new, path, options, folder):
    scene = thinned(json.loads(path.read_text()), options.speeds, options.revolutions)
    atlases = [folder / "old.h5", folder / "new.h5"]
    (status_old, sections_old, _, time_old), (status_new, sections_new, resolved, time_new) = (
        side.atlas_of(scene, atlas) for side, atlas in zip((old, new), atlases))
    class_old, class_new = (classes_of(new.program, atlas, atlas.with_suffix(".maps.h5")) for atlas in atlases)
    equal = (sections_old.view(np.uint64) == sections_new.view(np.uint64)).all(axis=(-2, -1)) | (
        np.isnan(sections_old) & np.isnan(sections_new)).all(axis=(-2, -1))
    periodic = (class_old == class_new) & (class_new >= 1) & (class_new <= LONGEST_PERIOD)
    unit = resolved["accuracy"]["tolerance"] * clearance_scale(resolved)
    apart = [distance(old, new) / unit for old, new in zip(sections_old[periodic], sections_new[periodic])]
    largest = f"{max(apart):.2g}" if apart else "-"
    print(f"| {path.stem} | {equal.size} | {int(equal.sum())} | {int((status_old != status_new).sum())} "
          f"| {int((class_old != class_new).sum())} | {largest} | {time_old / time_new:.2f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", type=Side)
    parser.add_argument("new", type=Side)
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    parser.add_argument("--speeds", type=int, default=9)
    parser.add_argument("--revolutions", type=int, default=140)
    options = parser.parse_intermixed_args()
    print("| scene | points | same bytes | other status | other class | periodic: apart, tolerances | times as fast |\n"
          "|---|--:|--:|--:|--:|--:|--:|")
    for path in options.scenes or sorted((ROOT / "jobs").glob("*.json")):
        with tempfile.TemporaryDirectory() as folder:
            try:
                compare(options.old, options.new, path, options, pathlib.Path(folder))
            except Refused:
                print(f"| {path.stem} | - | - | - | - | - | - |", flush=True)


if __name__ == "__main__":
    main()

#!/usr/bin/python3
"""What the pieces of lines change: each scene swept in pieces and from end to end, and both atlases compared.

    ./jobs/pieces.py [--ranks N] [--thin K] [--points P] [--lead-in L] [--random N] [--keep DIRECTORY] [SCENE.json ...]

Without scenes it takes all of this folder whose lines have more than one piece. --thin K keeps every K-th value of
each axis but the speed ratio. --random N adds N random rotors, swept up and down. Beside each comparison stands one of
two sweeps from end to end, of which one has a tolerance that is larger by 1 %: behind an aperiodic stretch the last
digits choose the motion, whoever sweeps.

Prints one row of a table for each scene: points; those that are periodic from end to end; of these, those that have
another class or maximum displacement in the control, and in pieces, each time followed by those among them that a chain
of periodic points joins to a seam before which both went on alike, in phase, too; the share of points that were
replaced at seams; and the work (right-hand sides and evaluations of the gap) of pieces over that of whole lines.
"""
import argparse
import json
import os
import pathlib
import random
import subprocess
import tempfile

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("RUBATLAS_PROGRAM", ROOT / "build/rubatlas")
LONGEST_PERIOD, REPAIRED = 16, 2
WHOLE = {"points": 1_000_000}
SLIGHTLY_LARGER = 1.01


def thinned(scene, every):
    def values(axis):
        if isinstance(axis, dict):
            axis = list(np.linspace(axis["from"], axis["to"], axis["count"]))
        return axis[::every] if isinstance(axis, list) else axis
    grid = {name: axis if name == "speed_ratio" else values(axis) for name, axis in scene["grid"].items()}
    return {**scene, "grid": grid}


def speeds(scene):
    axis = scene["grid"]["speed_ratio"]
    return axis["count"] if isinstance(axis, dict) else np.size(axis)


def random_scene(number):
    """A rotor whose lines have hysteresis, most of them."""
    chance = random.Random(number)
    law = chance.choice(["elastica", "elastic_ring"])
    scene = {"contact": {"law": law, "friction": chance.uniform(0.05, 0.35)},
             "rotor": {"damping_ratio": 10 ** chance.uniform(-1.5, -0.7)},
             "blades": {"count": chance.choice([1, 2, 3, 3, 3, 4, 5])}, "sweep": "both",
             "grid": {"speed_ratio": {"from": chance.uniform(0.05, 0.2), "to": chance.uniform(0.7, 0.95),
                                      "count": 400}}}
    if chance.random() < 0.5:
        scene["unbalance"] = {"moment": 10 ** chance.uniform(-6, -3.5)}
    return scene


class Sweep:
    """What is compared of an atlas, as lines of points in the order of their sweep."""

    def __init__(self, scene, name, options, directory):
        path, atlas, maps = (directory / f"{name}{end}" for end in (".json", ".h5", "_maps.h5"))
        path.write_text(json.dumps(scene))
        ranks = options.ranks
        launcher = ["mpirun", "-n", str(ranks), "--oversubscribe", "--bind-to", "none"] if ranks > 1 else []
        run = [*launcher, PROGRAM, "run", path, "-o", atlas, "--resume", "--progress", "off"]
        if (code := subprocess.run(run, check=False).returncode) not in (0, 10):
            raise SystemExit(code)
        subprocess.run([PROGRAM, "analyse", atlas, "-o", maps, "--overwrite"], check=True, stdout=subprocess.DEVNULL)
        runs = json.loads(pathlib.Path(f"{atlas}.run.json").read_text())["runs"]
        self.work = sum(run["right_hand_sides"] + run["gap_evaluations"] for run in runs)
        with h5py.File(atlas, "r") as file, h5py.File(maps, "r") as classes:
            self.displacement = self.lines(file["max_displacement"], file)
            self.motion = self.lines(classes["class"], file)
            self.end = np.stack([self.lines(file["final_state"][..., i], file) for i in range(4)], axis=-1)
            self.seam = self.lines(file["seam"], file) if "seam" in file else None
        self.periodic = (self.motion >= 1) & (self.motion <= LONGEST_PERIOD)

    @staticmethod
    def lines(dataset, file):
        axes = [scale.keys()[0] for scale in file["max_displacement"].dims]
        sweep = json.loads(file["scene_resolved"][()])["sweep"]
        values = dataset[...]
        if sweep == "both":
            values = np.moveaxis(values, axes.index("direction"), 0).copy()
            values[1] = values[1, ..., ::-1].copy()  # down
        elif sweep == "down":
            values = values[..., ::-1]
        return values.reshape(-1, values.shape[-1])

    def moved(self, other):
        """Points that are periodic here, and not the same in another sweep."""
        apart = np.abs(self.displacement - other.displacement) > 1e-6 * self.displacement
        return self.periodic & ((self.motion != other.motion) | apart)

    def ends_as(self, other):
        """Points from which both sweeps go on alike."""
        return np.abs(self.end - other.end).max(axis=-1) <= 1e-6 * self.displacement


def joined(periodic, alike, seams):
    """Which points periodic ones join to a seam, before which the motion was the same."""
    result = np.zeros_like(periodic)
    for line, line_periodic in enumerate(periodic):
        for seam in seams:
            if line_periodic[seam - 1] and alike[line, seam - 1]:
                ends = np.flatnonzero(~line_periodic[seam:])
                result[line, seam:seam + (ends[0] if ends.size else line_periodic.size)] = True
    return result


def row(name, scene, options, directory):
    wears = scene.get("wear", {}).get("carries_over", False)
    if scene.get("sweep") == "independent" or wears or speeds(scene) <= options.points:
        return None
    scene = {**scene, "observables": ["poincare", "max_displacement"], "pieces": WHOLE}
    tolerance = scene.get("accuracy", {}).get("tolerance", 1e-9)
    control = {**scene, "accuracy": {**scene.get("accuracy", {}), "tolerance": SLIGHTLY_LARGER * tolerance}}
    whole = Sweep(scene, f"{name}_whole", options, directory)
    other = Sweep(control, f"{name}_control", options, directory)
    scene["pieces"] = {"points": options.points, "lead_in": options.lead_in}
    cut = Sweep(scene, f"{name}_pieces", options, directory)
    seams = range(options.points, speeds(scene), options.points)
    numbers = [whole.motion.size, whole.periodic.sum()]
    for sweep in (other, cut):
        moved = whole.moved(sweep)
        numbers += [moved.sum(), (moved & joined(whole.periodic, whole.ends_as(sweep), seams)).sum()]
    return np.array([*numbers, (cut.seam == REPAIRED).sum(), whole.work, cut.work])


def shown(name, numbers):
    points, periodic, by_control, joined_there, moved, joined_here, replaced, work, work_of_pieces = numbers
    return (f"| {name} | {points} | {periodic} | {by_control} | {joined_there} | {moved} | {joined_here} | "
            f"{100 * replaced / points:.2f} % | {100 * (work_of_pieces - work) / max(work, 1):+.1f} % |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    parser.add_argument("--ranks", type=int, default=os.cpu_count())
    parser.add_argument("--thin", type=int, default=1)
    parser.add_argument("--points", type=int, default=48)
    parser.add_argument("--lead-in", type=int, default=0)
    parser.add_argument("--random", type=int, default=0)
    parser.add_argument("--keep", type=pathlib.Path, help="where atlases stay, to be gone on with")
    options = parser.parse_args()
    paths = options.scenes or ([] if options.random else sorted(ROOT.glob("jobs/*.json")))
    scenes = [(path.stem, thinned(json.loads(path.read_text()), options.thin)) for path in paths]
    scenes += [(f"random_{number}", random_scene(number)) for number in range(options.random)]
    with tempfile.TemporaryDirectory(prefix="rubatlas_pieces_") as scratch:
        directory = options.keep or pathlib.Path(scratch)
        directory.mkdir(parents=True, exist_ok=True)
        print("| scene | points | periodic | moved by 1 % of tolerance | joined | by pieces | joined | replaced "
              "| more work |")
        print("|---|--:|--:|--:|--:|--:|--:|--:|--:|")
        rows = []
        for name, scene in scenes:
            if (numbers := row(name, scene, options, directory)) is not None:
                rows.append(numbers)
                print(shown(f"`{name}`", numbers), flush=True)
        if rows:
            print(shown("together", sum(rows)))


if __name__ == "__main__":
    main()

#!/usr/bin/python3
"""What the pieces of lines change: each scene swept in pieces and from end to end, and both atlases compared.

    ./jobs/pieces.py [--ranks N] [--thin K] [--points P] [--lead-in L] [--keep DIRECTORY] [SCENE.json ...]

Without scenes it takes all of this folder whose lines have more than one piece. --thin K keeps every K-th value of
each axis but the speed ratio. Prints one row of a table for each scene: the share of points whose class differs; the
share of points that are periodic from end to end, and have another class or maximum displacement in pieces; the share
of points that were replaced at seams; and the work (right-hand sides and evaluations of the gap) of pieces over that of
whole lines.
"""
import argparse
import json
import os
import pathlib
import subprocess
import tempfile

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("RUBATLAS_PROGRAM", ROOT / "build/rubatlas")
LONGEST_PERIOD, REPAIRED = 16, 2
LONGER_THAN_ANY_LINE = 1_000_000


def thinned(scene, every):
    def values(axis):
        if isinstance(axis, dict):
            axis = list(np.linspace(axis["from"], axis["to"], axis["count"]))
        return axis[::every] if isinstance(axis, list) else axis
    grid = {name: axis if name == "speed_ratio" else values(axis) for name, axis in scene["grid"].items()}
    return {**scene, "grid": grid}


def speeds(scene):
    axis = scene["grid"]["speed_ratio"]
    return axis["count"] if isinstance(axis, dict) else len(axis)


def sweep(scene, pieces, name, directory, ranks):
    """Atlas, classes and work of a scene in these pieces."""
    path, atlas, maps = (directory / f"{name}{end}" for end in (".json", ".h5", "_maps.h5"))
    path.write_text(json.dumps({**scene, "pieces": pieces}))
    launcher = ["mpirun", "-n", str(ranks), "--oversubscribe", "--bind-to", "none"] if ranks > 1 else []
    subprocess.run([*launcher, PROGRAM, "run", path, "-o", atlas, "--resume", "--progress", "off"], check=False)
    subprocess.run([PROGRAM, "analyse", atlas, "-o", maps, "--overwrite"], check=True, stdout=subprocess.DEVNULL)
    runs = json.loads(pathlib.Path(f"{atlas}.run.json").read_text())["runs"]
    with h5py.File(atlas, "r") as file, h5py.File(maps, "r") as classes:
        return (file["max_displacement"][...], file["seam"][...], classes["class"][...],
                sum(run["right_hand_sides"] + run["gap_evaluations"] for run in runs))


def row(path, options, directory):
    scene = json.loads(path.read_text())
    wears = scene.get("wear", {}).get("carries_over", False)
    if scene.get("sweep") == "independent" or wears or speeds(scene) <= options.points:
        return None
    scene = thinned({**scene, "observables": ["poincare", "max_displacement"]}, options.thin)
    whole, _, class_of_whole, work_of_whole = sweep(scene, {"points": LONGER_THAN_ANY_LINE}, f"{path.stem}_whole",
                                                    directory, options.ranks)
    cut, seam, class_of_cut, work = sweep(scene, {"points": options.points, "lead_in": options.lead_in},
                                          f"{path.stem}_pieces", directory, options.ranks)
    periodic = (class_of_whole >= 1) & (class_of_whole <= LONGEST_PERIOD)
    other_class = class_of_cut != class_of_whole
    moved = periodic & (other_class | (np.abs(cut - whole) > 1e-6 * whole))

    def share(points, of):
        return f"{np.count_nonzero(points)} ({100 * np.count_nonzero(points) / max(of, 1):.2f} %)"

    return (f"| `{path.stem}` | {whole.size} | {share(other_class, whole.size)} | "
            f"{share(moved, np.count_nonzero(periodic))} | {share(seam == REPAIRED, whole.size)} | "
            f"{100 * (work / work_of_whole - 1):+.1f} % |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    parser.add_argument("--ranks", type=int, default=os.cpu_count())
    parser.add_argument("--thin", type=int, default=1)
    parser.add_argument("--points", type=int, default=64)
    parser.add_argument("--lead-in", type=int, default=8)
    parser.add_argument("--keep", type=pathlib.Path, help="where atlases stay, to be gone on with")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="rubatlas_pieces_") as scratch:
        directory = options.keep or pathlib.Path(scratch)
        directory.mkdir(parents=True, exist_ok=True)
        print("| scene | points | other class | periodic, and moved | replaced | more work |")
        print("|---|---|---|---|---|---|")
        for path in options.scenes or sorted(ROOT.glob("jobs/*.json")):
            if line := row(path, options, directory):
                print(line, flush=True)


if __name__ == "__main__":
    main()

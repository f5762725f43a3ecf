"""What an effect costs: processor time a revolution of each shipped effect, and of the default rotor's first.

    /usr/bin/python3 tests/bench/effects.py PROGRAM [EFFECT...]

Ninety speeds of `jobs/effect_<name>.json`, up to 200 revolutions each, of which those count that have been run (a
motion that leaves the model ends); sections, displacement and touch-downs only; the start of the program is taken off;
the least of three runs. Ratios are of use on a busy machine too. Beside them stand the touch-downs a revolution: an
effect may lead to motions that touch far more often.
"""
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

import h5py
import numpy as np

JOBS = pathlib.Path(__file__).resolve().parents[2] / "jobs"
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
SPEEDS, REVOLUTIONS, RUNS = 90, 200, 3


def seconds(program, scene, directory):
    (directory / "scene.json").write_text(json.dumps(scene))
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([program, "run", directory / "scene.json", "-o", directory / "atlas.h5", "--overwrite", "--progress",
                    "off"], env=ENVIRONMENT, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL, check=True)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def cost_of(program, path, directory):
    """Microseconds and touch-downs a revolution."""
    scene = json.loads(path.read_text())
    scene["observables"] = ["poincare", "max_displacement", "touchdowns_per_revolution"]
    whole = {**scene, "grid": {"speed_ratio": {"from": 0.07, "to": 0.93, "count": SPEEDS}},
             "protocol": {"transient_revolutions": REVOLUTIONS // 2, "sampled_revolutions": REVOLUTIONS // 2,
                          "settle": "never"}}
    start = {**scene, "grid": {"speed_ratio": [0.07]},
             "protocol": {"transient_revolutions": 1, "sampled_revolutions": 1}}
    starting = min(seconds(program, start, directory) for _ in range(RUNS))
    running = min(seconds(program, whole, directory) for _ in range(RUNS))
    with h5py.File(directory / "atlas.h5", "r") as file:
        ended, touchdowns = file["failed_revolution"][...], file["touchdowns_per_revolution"][...]
    run = np.where(ended < 0, REVOLUTIONS, ended).sum()
    return 1e6 * (running - starting) / run, touchdowns[ended < 0].mean()


def main():
    program, *names = sys.argv[1:]
    paths = [JOBS / f"effect_{name}.json" for name in names] or sorted(JOBS.glob("effect_*.json"))
    print("| scene | µs a revolution | of the default rotor's | touch-downs a revolution |\n|---|--:|--:|--:|")
    with tempfile.TemporaryDirectory() as name:
        first = None
        for path in [JOBS / "default.json", *paths]:
            cost, touchdowns = cost_of(program, path, pathlib.Path(name))
            first = first or cost
            print(f"| {path.stem.removeprefix('effect_')} | {cost:.1f} | {cost / first:.2f} | {touchdowns:.2f} |",
                  flush=True)


if __name__ == "__main__":
    main()

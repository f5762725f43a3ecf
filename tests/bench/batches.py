"""Time of whole atlases computed with lines side by side in SIMD lanes, against line by line.

    /usr/bin/python3 tests/bench/batches.py PROGRAM REPEATS SPEEDS RANKS SCENE.json...

Scenes are thinned out to SPEEDS speed ratios. Both ways in turn; medians of the time that all ranks spend with points (from
the run record: a rank that waits for the last line of another spends none) and of the ratios, and the ratio of the time of
the whole command, mpirun and the file included. It wants as many idle cores as ranks. RANKS 0: without mpirun. Fails where
the atlases differ in a byte.
"""
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def seconds(program, ranks, scene, atlas, environment):
    """With points, all ranks together, and of the whole command."""
    launcher = ["mpirun", "-q", "--oversubscribe", "--bind-to", "none", "-n", str(ranks)] if ranks else []
    began = time.monotonic()
    job = subprocess.run([*launcher, program, "run", scene, "-o", atlas, "--overwrite", "--progress", "off"],
                         env={**ENVIRONMENT, **environment}, check=False)
    elapsed = time.monotonic() - began
    if job.returncode not in (0, 10):  # 10: some points could not be integrated
        sys.exit(f"{scene}: the program ended with {job.returncode}")
    record = json.loads(pathlib.Path(f"{atlas}.run.json").read_text())
    return sum(record["runs"][-1]["busy_seconds_of_rank"]), elapsed


def compare(program, repeats, speeds, ranks, scene, directory):
    content = json.loads(pathlib.Path(scene).read_text())
    content["grid"]["speed_ratio"]["count"] = speeds
    thinned = directory / "scene.json"
    thinned.write_text(json.dumps(content))
    by_line, batched = directory / "by_line.h5", directory / "batched.h5"
    alone, together = [], []
    for _ in range(repeats):
        alone.append(seconds(program, ranks, thinned, by_line, {"RUBATLAS_LANES": "1"}))
        together.append(seconds(program, ranks, thinned, batched, {}))
        if by_line.read_bytes() != batched.read_bytes():
            sys.exit(f"{scene}: the atlases differ")
    points, whole = (statistics.median(one[i] / other[i] for one, other in zip(alone, together)) for i in (0, 1))
    with_points = [statistics.median(busy for busy, _ in runs) for runs in (alone, together)]
    print(f"| {pathlib.Path(scene).stem} | {ranks or 1} | {with_points[0]:.2f} | {with_points[1]:.2f} | {points:.2f} "
          f"| {whole:.2f} |", flush=True)


def main():
    program, repeats, speeds, ranks, *scenes = sys.argv[1:]
    print("| scene | ranks | line by line (s) | side by side (s) | × | whole command × |\n|---|--:|--:|--:|--:|--:|")
    with tempfile.TemporaryDirectory() as directory:
        for scene in scenes:
            compare(program, int(repeats), int(speeds), int(ranks), scene, pathlib.Path(directory))


if __name__ == "__main__":
    main()

"""CPU time of whole atlases computed with lines side by side in SIMD lanes, against line by line.

    /usr/bin/python3 tests/bench/batches.py PROGRAM REPEATS SPEEDS RANKS SCENE.json...

Scenes are thinned out to SPEEDS speed ratios. Both ways in turn; user and system time of all ranks, mpirun included; median
of the ratios. RANKS 0: without mpirun. Fails where the atlases differ in a byte.
"""
import json
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def processor_seconds(program, ranks, scene, atlas, environment):
    launcher = ["mpirun", "-q", "--oversubscribe", "--bind-to", "none", "-n", str(ranks)] if ranks else []
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    job = subprocess.run([*launcher, program, "run", scene, "-o", atlas, "--overwrite", "--progress", "off"],
                         env={**ENVIRONMENT, **environment}, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if job.returncode not in (0, 1):  # 1: some points left the model
        sys.exit(f"{scene}: the program ended with {job.returncode}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def compare(program, repeats, speeds, ranks, scene, directory):
    content = json.loads(pathlib.Path(scene).read_text())
    content["grid"]["speed_ratio"]["count"] = speeds
    thinned = directory / "scene.json"
    thinned.write_text(json.dumps(content))
    by_line, batched = directory / "by_line.h5", directory / "batched.h5"
    pairs = []
    for _ in range(repeats):
        pairs.append((processor_seconds(program, ranks, thinned, by_line, {"RUBATLAS_LANES": "1"}),
                      processor_seconds(program, ranks, thinned, batched, {})))
        if by_line.read_bytes() != batched.read_bytes():
            sys.exit(f"{scene}: the atlases differ")
    alone, together = (statistics.median(column) for column in zip(*pairs))
    ratio = statistics.median(one / other for one, other in pairs)
    print(f"| {pathlib.Path(scene).stem} | {ranks or 1} | {alone:.2f} | {together:.2f} | {ratio:.2f} |", flush=True)


def main():
    program, repeats, speeds, ranks, *scenes = sys.argv[1:]
    print("| scene | ranks | line by line (s) | side by side (s) | × |\n|---|--:|--:|--:|--:|")
    with tempfile.TemporaryDirectory() as directory:
        for scene in scenes:
            compare(program, int(repeats), int(speeds), int(ranks), scene, pathlib.Path(directory))


if __name__ == "__main__":
    main()

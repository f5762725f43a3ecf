"""Points a second of a job whose points cost nothing: what is left is everything around the integration.

    /usr/bin/python3 tests/bench/cheap_points.py 1,2,4,8,16,32,64 PROGRAM...

A hundred lines of a thousand points, one sampled revolution each; no blade reaches the ring. Each program in turn for
each number of ranks. 0 ranks: without mpirun. Points a second and the microseconds of processor time a point, of all
ranks and of mpirun together, their start and end included; the second number is of use on a busy machine too.
"""
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
LINES, SPEEDS = 100, 1000
SCENE = {
    "title": "points that cost nothing", "reference": "none", "rotor": {"misalignment": 0.001},
    "grid": {"speed_ratio": {"from": 0.1, "to": 0.8, "count": SPEEDS},
             "damping_ratio": {"from": 0.05, "to": 0.5, "count": LINES}},
    "protocol": {"transient_revolutions": 0, "sampled_revolutions": 1, "samples_per_revolution": 32},
    "spectrum": {"max_order": 12},
}


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def measure(program, ranks, directory):
    launcher = ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", str(ranks)] if ranks else []
    atlas = directory / "atlas.h5"
    before = processor_seconds()
    subprocess.run([*launcher, program, "run", directory / "scene.json", "-o", atlas, "--overwrite", "--progress",
                    "off"],
                   env=ENVIRONMENT, stderr=subprocess.DEVNULL, check=True)
    record = json.loads(pathlib.Path(f"{atlas}.run.json").read_text())["runs"][-1]
    return record["points_per_second"], 1e6 * (processor_seconds() - before) / (LINES * SPEEDS)


def main():
    counts, *programs = sys.argv[1:]
    print("| ranks | program | points a second | µs of processor time a point |\n|--:|---|--:|--:|")
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        (directory / "scene.json").write_text(json.dumps(SCENE))
        for ranks in map(int, counts.split(",")):
            for program in programs:
                rate, cost = measure(program, ranks, directory)
                print(f"| {ranks or 'no mpirun'} | {program} | {rate:.0f} | {cost:.1f} |", flush=True)


if __name__ == "__main__":
    main()

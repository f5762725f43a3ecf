"""Runs the program as its users do, alone or under mpirun, on scenes that take a second."""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))

from mpi_environment import ENVIRONMENT  # noqa: E402

PROGRAM = os.environ["RUBATLAS_PROGRAM"]
PENDING, DONE, LEFT_VALIDITY, INTEGRATOR_FAILED = 0, 1, 2, 3
TIME_LIMIT = 120  # s; a job that hangs fails its test instead of the whole suite
COMPUTING = 0.5  # s of processor time, of which the start of MPI takes about 0.1: who has used as much computes

_version = subprocess.run(["mpirun", "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout
OPEN_MPI = int(re.search(r"\) (\d+)\.", _version)[1])
# Where a job ends with another code than 0, Open MPI 4.1 waits a second before it ends ranks that have ended by
# themselves.
AT_ITS_END = {"OMPI_MCA_odls_base_sigkill_timeout": "0"}


_WHOLE = {}  # by scene: see JobTest.whole

FAILING = [0.02, 0.05, 0.1]  # damping ratios: at the first two some points leave the model's validity


def scene(**changes):
    """Three short lines of the default rotor through its chaotic region; every point ends as done."""
    return {
        "title": "short lines", "reference": "none",
        "grid": {"speed_ratio": {"from": 0.2, "to": 0.9, "count": 12}, "damping_ratio": [0.1, 0.15, 0.2]},
        "protocol": {"transient_revolutions": 10, "sampled_revolutions": 8, "samples_per_revolution": 32},
        "spectrum": {"max_order": 4},
        **changes,
    }


def long_scene(transient_revolutions=400, **changes):
    """The same lines with enough points and revolutions that something can happen in the middle."""
    return scene(grid={"speed_ratio": {"from": 0.2, "to": 0.9, "count": 60}, "damping_ratio": [0.1, 0.15, 0.2]},
                 protocol={"transient_revolutions": transient_revolutions, "sampled_revolutions": 20,
                           "samples_per_revolution": 32, "settle": "never"}, **changes)


def command(ranks, *arguments):
    """`ranks` None: without mpirun."""
    launcher = [] if ranks is None else ["mpirun", "-n", str(ranks), "--oversubscribe", "--bind-to", "none"]
    return [*launcher, PROGRAM, *map(str, arguments)]


class JobTest(unittest.TestCase):
    """A test with a directory of its own."""

    def setUp(self):
        self.directory = pathlib.Path(tempfile.mkdtemp(prefix="rubatlas_"))
        self.addCleanup(shutil.rmtree, self.directory)

    def write_scene(self, content, name="scene.json"):
        path = self.directory / name
        path.write_text(content if isinstance(content, str) else json.dumps(content))
        return path

    def execute(self, ranks, *arguments, **environment):
        """Runs to the end; the completed process has its text in stdout and stderr."""
        job = subprocess.run(command(ranks, *arguments), env={**ENVIRONMENT, **AT_ITS_END, **environment},
                             cwd=self.directory,
                             capture_output=True, timeout=TIME_LIMIT, check=False)
        # Decoded here: Python's own text mode would turn the carriage returns of a progress bar into newlines.
        job.stdout, job.stderr = job.stdout.decode(), job.stderr.decode()
        return job

    def fill(self, ranks, content, name="atlas.h5", *options):
        """Runs a scene to its end, however its points end, and returns the atlas' path."""
        atlas = self.directory / name
        job = self.execute(ranks, "run", self.write_scene(content), "-o", atlas, "--progress", "off", *options)
        self.assertEqual(job.returncode, 0, job.stderr)
        return atlas

    def whole(self, content):
        """The atlas of a scene that one process has run to its end; to be read only, since the tests of a class share
        it."""
        key = json.dumps(content, sort_keys=True)
        if key not in _WHOLE:
            _WHOLE[key] = tempfile.TemporaryDirectory(prefix="rubatlas_")  # until Python ends
            shutil.move(self.fill(None, content, "whole.h5"), _WHOLE[key].name)
        return pathlib.Path(_WHOLE[key].name) / "whole.h5"

    def start(self, ranks, content, atlas, *options, **environment):
        """Starts a job and returns at once. Its statuses follow their rows at once: who waits for one sees it come."""
        for option, value in (("--progress", "off"), ("--batch-milliseconds", "0")):
            if option not in options:
                options = (*options, option, value)
        job = subprocess.Popen(command(ranks, "run", self.write_scene(content), "-o", atlas, *options),
                               env={**ENVIRONMENT, **environment}, cwd=self.directory, stderr=subprocess.PIPE,
                               text=True)
        self.addCleanup(lambda: (job.poll() is None and job.kill(), job.wait(), job.stderr.close()))
        return job

    def wait_until_it_computes(self, job, ranks):
        """Returns the processes of the program, `ranks` many or the job itself, when each of them computes."""
        def computing():
            found = [job.pid] if ranks is None else ranks_of(job)
            return len(found) == (ranks or 1) and all(processor_seconds(one) > COMPUTING for one in found) and found

        found = wait_for(lambda: job.poll() is not None or computing())
        self.assertIsNone(job.poll(), "the job has ended")
        self.assertTrue(found, "the job does not compute")
        return found

    def assert_refused(self, job, exit_code, *parts):
        """One sentence on stderr that has all `parts`, from one rank only."""
        said = [line for line in job.stderr.splitlines() if line.startswith("rubatlas:")]
        self.assertEqual(len(said), 1, job.stderr)
        for part in parts:
            self.assertIn(part, said[0])
        self.assertEqual(job.returncode, exit_code, job.stderr)

    def assert_says_nothing_of(self, **effect):
        """An atlas whose effect has no strength holds what one without its section does."""
        with h5py.File(self.fill(None, scene(**effect), "idle.h5"), "r") as idle, \
                h5py.File(self.fill(None, scene(), "none.h5"), "r") as none:
            self.assertEqual(set(idle), set(none))
            for name in set(none) - {"scene", "scene_resolved"}:
                self.assertEqual(idle[name][()].tobytes(), none[name][()].tobytes(), name)

    def assert_survives_a_kill(self, content):
        """A job of two ranks, one of which is killed at work, goes on to the same bytes."""
        atlas = self.directory / "killed.h5"
        job = self.start(2, content, atlas)
        wait_for_points(job, atlas, 20)
        os.kill(ranks_of(job)[0], signal.SIGKILL)
        job.wait(timeout=60)
        whole = self.whole(content)
        self.assertLess(self.assert_no_wrong_row(atlas, whole), 180, "the job ended before the kill")
        self.assert_same_bytes(whole, self.fill(2, content, atlas.name, "--resume"))

    def assert_no_wrong_row(self, atlas, whole):
        """Every row that says done is the row of the uninterrupted run; returns how many say so."""
        with h5py.File(atlas, "r") as part, h5py.File(whole, "r") as full:
            finished = part["status"][...] != PENDING
            for name in (*full["row_checksum"].attrs["order"].split(), "row_checksum"):
                np.testing.assert_array_equal(part[name][...][finished], full[name][...][finished], err_msg=name)
            return int(finished.sum())

    def assert_same_bytes(self, one, other):
        # Compared as a whole first: a difference of megabytes is no message.
        if one.read_bytes() != other.read_bytes():
            self.fail(f"{one.name} and {other.name} differ: " + ", ".join(differing_datasets(one, other)))


def differing_datasets(one, other):
    """Names of the datasets, and of the root's attributes, that two atlases do not have alike."""
    def content(value):
        return value if isinstance(value, (bytes, str)) else np.asarray(value).tobytes()

    def differing(a, b):
        return [name for name in sorted(set(a) | set(b)) if name not in a or name not in b or
                content(a[name][()] if isinstance(a, h5py.File) else a[name]) !=
                content(b[name][()] if isinstance(b, h5py.File) else b[name])]

    with h5py.File(one, "r") as a, h5py.File(other, "r") as b:
        return differing(a, b) + differing(a.attrs, b.attrs) or ["no dataset and no attribute, but the file"]


def wait_for(condition, seconds=TIME_LIMIT):
    """Returns what the condition returns when that is true, or in the end; the limit is for hangs."""
    end = time.monotonic() + seconds
    while not (met := condition()) and time.monotonic() < end:
        time.sleep(0.01)
    return met


def wait_for_points(job, atlas, count):
    """Returns when at least `count` points of the atlas are no longer pending, or the job has ended."""
    end = time.monotonic() + TIME_LIMIT
    while job.poll() is None and not atlas.exists():
        time.sleep(0.002)
    if not atlas.exists():
        return
    # Where the statuses are never changes, so the bytes can be looked at without HDF5.
    with h5py.File(atlas, "r") as file:
        place, size = file["status"].id.get_offset(), file["status"].size
    with open(atlas, "rb", buffering=0) as raw:
        while job.poll() is None and time.monotonic() < end:
            raw.seek(place)
            if np.count_nonzero(np.frombuffer(raw.read(size), np.uint8)) >= count:
                return
            time.sleep(0.002)


def stat_of(process):
    """Fields of /proc/PID/stat from the process' state on; none where it is gone."""
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
    except (FileNotFoundError, ProcessLookupError):
        return []


def has_ended(process):
    """Gone, or a zombie that nobody has asked for."""
    return stat_of(process)[:1] in ([], ["Z"])


def processor_seconds(process):
    """Processor time that a process has used."""
    return sum(map(int, stat_of(process)[11:13])) / os.sysconf("SC_CLK_TCK")


def pauses(process):
    """How often a process has slept: a rank that computes does not, and one that waits for another does so again and
    again."""
    text = pathlib.Path(f"/proc/{process}/status").read_text()
    return int(re.search(r"^voluntary_ctxt_switches:\s*(\d+)", text, re.MULTILINE)[1])


def ranks_of(job):
    """Process numbers of the ranks that an mpirun has started."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        if entry.name.isdigit() and stat_of(entry.name)[1:2] == [str(job.pid)]:
            found.append(int(entry.name))
    return sorted(found)

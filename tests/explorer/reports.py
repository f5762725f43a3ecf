"""Reports for the tests: of the tiny atlas, and of small atlases with scenes of their own."""
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
PROGRAM = pathlib.Path(os.environ["RUBATLAS_PROGRAM"])
TINY = PROGRAM.parent / "tests/tiny_atlas"
WITHOUT_SOLVER = os.environ.get("RUBATLAS_WITHOUT_SOLVER", "")  # why no solver was built, if none was
SOLVER = [] if WITHOUT_SOLVER else ["--solver", PROGRAM.parent / "rubatlas.wasm"]
sys.path.insert(0, str(ROOT / "tests/support"))

from forked_commands import ended_command  # noqa: E402


def report(*arguments, environment=None):
    """The command, ended."""
    return ended_command("rubatlas-report", *arguments, environment=environment)


def made(output, source, *arguments, solver=True):
    """A report at `output`, which must come into being."""
    ended = report(source, "-o", output, *(SOLVER if solver else []), *arguments)
    if ended.returncode != 0:
        raise AssertionError(ended.stderr)
    return pathlib.Path(output)


def tiny(folder):
    return made(folder / "tiny.html", TINY / "atlas.h5", "--maps", TINY / "maps.h5")


def run(folder, name, scene):
    """An atlas of a scene, computed by the program."""
    path = folder / f"{name}.json"
    path.write_text(json.dumps(scene))
    atlas = folder / f"{name}.h5"
    ended = subprocess.run([PROGRAM, "run", path, "-o", atlas, "--overwrite", "--progress", "off"], capture_output=True,
                           text=True,
                           check=False)
    if ended.returncode != 0:
        raise AssertionError(ended.stderr)
    return atlas

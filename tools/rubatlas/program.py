"""The program `rubatlas`, called from Python: its commands with their options as keywords."""
import contextlib
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from rubatlas.atlas_file import AtlasError

Path = str | os.PathLike[str]


class Unfinished(AtlasError):
    """The program was stopped, or points are missing in what it has written."""


def find_program(program: Path | None = None) -> pathlib.Path:
    """The program: the argument, RUBATLAS_PROGRAM of the environment, `rubatlas` on the PATH, or build/rubatlas of the
    clone that this package lies in."""
    clone = pathlib.Path(__file__).resolve().parents[2] / "build" / "rubatlas"
    named = program or os.environ.get("RUBATLAS_PROGRAM")
    places: list[Path | None] = [named] if named else [shutil.which("rubatlas"), clone]
    for place in places:
        if place is not None and os.access(place, os.X_OK):
            return pathlib.Path(place)
    what = f"{named}: no program that can be run" if named else "the program rubatlas is not found"
    raise AtlasError(f"{what}; name it by RUBATLAS_PROGRAM in the environment or by program=, put it on the PATH, or "
                     "build it in the clone")


def call(arguments: Sequence[Path], program: Path | None = None, ranks: int = 1) -> str:
    """Runs the program and returns what it prints; AtlasError with its own sentence where it refuses, and Unfinished
    where points are missing."""
    if ranks < 1:
        raise AtlasError(f"ranks {ranks}: at least one")
    command = [str(find_program(program)), *map(str, arguments)]
    environment = dict(os.environ)
    if ranks > 1:
        # More ranks than cores are allowed, and root too, as on a machine of one's own.
        command = ["mpirun", "--oversubscribe", "-n", str(ranks), *command]
        environment.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    ended = subprocess.run(command, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                           check=False)
    if ended.returncode not in (0, 10):  # 10: some points could not be integrated; the atlas says so of each
        said = [line for line in ended.stderr.splitlines() if line.startswith("rubatlas:")]
        kind = Unfinished if ended.returncode == 75 else AtlasError
        raise kind(said[-1] if said
                   else f"{command[0]} ended with exit code {ended.returncode}: {ended.stderr.strip()[-300:]}")
    return ended.stdout


def _words(name: str, value: Any) -> list[str]:
    """An option as the command line has it. A name that Python keeps for itself ends in an underscore: `from_`.

    >>> _words("from_", {"speed_ratio": 0.62})
    ['--from', 'speed_ratio=0.62']
    >>> _words("force_increments", [0.1, 1.0]), _words("both", True), _words("to", None)
    (['--force-increments', '0.1', '1.0'], ['--both'], [])
    """
    option = f"--{name.removesuffix('_').replace('_', '-')}"
    if value is None or value is False:
        return []
    if value is True:
        return [option]
    if isinstance(value, Mapping):
        return [option, *(f"{key}={one}" for key, one in value.items())]
    several = isinstance(value, Iterable) and not isinstance(value, str)
    return [option, *map(str, value if several else [value])]


def command(name: str, *inputs: Path, output: Path | None = None, program: Path | None = None, ranks: int = 1,
            **options: Any) -> str:
    """Any command of the program: its files, its output, and its options as keywords; returns what it prints.

    An option is a number or a text, a list of them, a dict for NAME=VALUE, or True where it has no value:
    `command("branch", "default.json", output="b.h5", from_={"speed_ratio": 0.62}, along="speed_ratio", both=True)`.
    """
    words = [word for option, value in options.items() for word in _words(option, value)]
    return call([name, *inputs, *(["-o", output] if output is not None else []), *words], program, ranks)


def scene_text(scene: Mapping[str, Any]) -> str:
    """A scene as JSON; arrays and numbers of numpy are lists and numbers."""
    try:
        return json.dumps(scene, indent=2, default=lambda value: value.tolist()) + "\n"
    except (AttributeError, TypeError, ValueError) as error:
        raise AtlasError(f"the scene is not one of JSON: {error}") from None


@contextlib.contextmanager
def scene_file(scene: Mapping[str, Any] | Path) -> Iterator[Path]:
    """A scene as a file: the one that is named, or for the time of the block one of what a dict says."""
    if not isinstance(scene, Mapping):
        yield scene
        return
    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder) / "scene.json"
        place.write_text(scene_text(scene), encoding="utf-8")
        yield place

"""The program `rubatlas`, called from Python."""
import os
import pathlib
import shutil
import subprocess
from collections.abc import Sequence

from rubatlas.atlas_file import AtlasError

Path = str | os.PathLike[str]


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
    """Runs the program and returns what it prints; AtlasError with its own sentence where it refuses."""
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
    # 10: some points could not be integrated, which the atlas says of each.
    if ended.returncode not in (0, 10):
        said = [line for line in ended.stderr.splitlines() if line.startswith("rubatlas:")]
        raise AtlasError(said[-1] if said
                         else f"{command[0]} ended with exit code {ended.returncode}: {ended.stderr.strip()[-300:]}")
    return ended.stdout

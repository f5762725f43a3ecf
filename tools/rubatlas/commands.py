"""Commands of the program as functions: what they write is read and returned.

    branch = rubatlas.branch("default.json", "branch.h5", from_={"speed_ratio": 0.62}, along="speed_ratio", both=True)
    print(rubatlas.verify("default.h5", recompute=20))

A scene is a file, a dict, or an atlas, of which it is that scene; `run` takes a dict alone. Further keywords are the
command's options, without the dashes, `from_` with an underscore since Python keeps the word; `rubatlas branch
--help` lists them. What the program refuses is an AtlasError with its own sentence. Commands without a function here
are called by `command`.
"""
from __future__ import annotations

import contextlib
import pathlib
from collections.abc import Iterable, Mapping
from typing import Any

import xarray

from rubatlas.accuracy_file import AccuracyFile
from rubatlas.atlas import Atlas, read_edges
from rubatlas.atlas_file import AtlasError
from rubatlas.plots.branch import BranchFile
from rubatlas.program import Path, Unfinished, command, scene_file, scene_text

Scene = Mapping[str, Any] | Path | Atlas


def _scene(scene: Scene) -> Mapping[str, Any] | Path:
    return scene.own_scene if isinstance(scene, Atlas) else scene


def _path(atlas: Atlas | Path) -> pathlib.Path:
    return pathlib.Path(atlas.path if isinstance(atlas, Atlas) else atlas)


def _options(given: Scene, options: Mapping[str, Any]) -> dict[str, Any]:
    """With the program that an atlas was opened with, unless another one is named."""
    return {"program": given.program, **options} if isinstance(given, Atlas) else dict(options)


def run(scene: Mapping[str, Any], output: Path, ranks: int = 1, program: Path | None = None) -> Atlas:
    """Writes the scene beside `output`, runs the program, or goes on with what is there, analyses, and opens the atlas.

    The scene is that of the program, as a dict. An atlas of another scene is refused, not replaced.
    """
    place = pathlib.Path(output)
    if not place.parent.is_dir():
        raise AtlasError(f"{place}: there is no folder {place.parent}")
    scene_place = place.with_suffix(".json")
    content = scene_text(scene)
    new = not scene_place.exists()
    if not new and scene_place.read_text(encoding="utf-8") != content:
        raise AtlasError(f"{scene_place}: another scene is there; choose another output")
    scene_place.write_text(content, encoding="utf-8")
    kept = place.exists()
    try:
        command("run", scene_place, output=place, program=program, ranks=ranks, resume=True, progress="off")
    except AtlasError:
        if new and (kept or not place.exists()):
            scene_place.unlink()  # refused: the next one may be right
        raise
    command("analyse", place, output=place.with_name(f"{place.stem}_maps.h5"), program=program, overwrite=True)
    return Atlas(place, program=program)


def branch(scene: Scene, output: Path, **options: Any) -> BranchFile:
    """Periodic orbits followed along a quantity, stable or not (`from_`, `along`, `to`, `both`, `curve`, …)."""
    with scene_file(_scene(scene)) as place:
        command("branch", place, output=output, **_options(scene, options))
    return BranchFile(output)


def accuracy(scene: Scene, output: Path, **options: Any) -> AccuracyFile:
    """What accuracy costs: the scene by every method and tolerance (`methods`, `tolerances`, `repeats`, …)."""
    with scene_file(_scene(scene)) as place:
        command("accuracy", place, output=output, **_options(scene, options))
    return AccuracyFile(output)


def edges(atlas: Atlas | Path, output: Path | None = None, **options: Any) -> xarray.Dataset:
    """Where the motion of an atlas changes, narrowed down by new points (`to`, `regions`, `ranks`, …), into
    ATLAS_edges.h5 beside the atlas, where `Atlas.edges` finds them, or into `output`."""
    place = _path(atlas)
    command("edges", place, output=output, **_options(atlas, options))
    return read_edges(str(output or place.with_name(f"{place.stem}_edges.h5")))


def verify(atlas: Atlas | Path, **options: Any) -> str:
    """What the program says of the rows of an atlas: whether they have their checksums, and of `recompute` rows the
    same bits; AtlasError where they have not."""
    return command("verify", _path(atlas), **_options(atlas, options)).strip()


def merge(parts: Iterable[Atlas | Path], output: Path, **options: Any) -> Atlas:
    """One atlas of the parts that `run --part` has computed; points of parts that are missing are not done."""
    parts = list(parts)
    options = _options(parts[0], options) if parts else options
    with contextlib.suppress(Unfinished):
        command("merge", *map(_path, parts), output=output, **options)
    return Atlas(output, program=options.get("program"))

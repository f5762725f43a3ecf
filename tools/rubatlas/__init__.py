"""Reads, queries and draws atlases of a rotor with rubbing blades, which the program rubatlas computes.

    atlas = rubatlas.open("quick.h5")
    atlas = rubatlas.run({"grid": {"speed_ratio": [0.3, 0.4]}}, "two.h5", ranks=2)
    calm = atlas.sel(0.3).where("class == 'period 1'")

`open` and `run` give an `Atlas`. `branch`, `edges`, `verify`, `accuracy` and `merge` are commands of the program as
functions, and `command` calls any of them. `signature` measures the signs of rubbing in a spectrum.
"""
import importlib
from typing import TYPE_CHECKING, Any

from rubatlas.atlas_file import AtlasError
from rubatlas.signature import signature

if TYPE_CHECKING:
    from rubatlas.atlas import Atlas, open  # noqa: A004  # pylint: disable=redefined-builtin
    from rubatlas.commands import accuracy, branch, edges, merge, run, verify
    from rubatlas.program import command

_PLACES = {"Atlas": "atlas", "open": "atlas", "command": "program",
           **dict.fromkeys(("accuracy", "branch", "edges", "merge", "run", "verify"), "commands")}
__all__ = ["Atlas", "AtlasError", "accuracy", "branch", "command", "edges", "merge", "open", "run",
           "signature", "verify"]
__version__ = "1.0.0"


def __getattr__(name: str) -> Any:
    # The commands that draw files do not wait for xarray.
    if name in _PLACES:
        return getattr(importlib.import_module(f"rubatlas.{_PLACES[name]}"), name)
    raise AttributeError(f"module rubatlas has no attribute {name}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})

"""Reads, queries and draws atlases of a rotor with rubbing blades, which the program rubatlas computes.

    atlas = rubatlas.open("quick.h5")
    atlas = rubatlas.run({"grid": {"speed_ratio": [0.3, 0.4]}}, "two.h5", ranks=2)
"""
from typing import TYPE_CHECKING, Any

from rubatlas.atlas_file import AtlasError

if TYPE_CHECKING:
    from rubatlas.atlas import Atlas, open, run  # noqa: A004  # pylint: disable=redefined-builtin

__all__ = ["Atlas", "AtlasError", "open", "run"]
__version__ = "1.0.0"


def __getattr__(name: str) -> Any:
    # The commands that draw files do not wait for xarray.
    if name in ("Atlas", "open", "run"):
        from rubatlas import atlas  # pylint: disable=import-outside-toplevel
        return getattr(atlas, name)
    raise AttributeError(f"module rubatlas has no attribute {name}")

"""Names, colours and hatchings of the classes of motion, and of points without a motion, as data for pictures and page.

The darker a class is, the longer its period: its lightness alone tells it from the others, in greyscale and under the
common colour deficiencies. What is no motion, or none that was resolved, is hatched, in patterns of its own.
"""
import json
import pathlib
from typing import Any

PALETTE: dict[str, Any] = json.loads(pathlib.Path(__file__).with_name("palette.json").read_text(encoding="utf-8"))

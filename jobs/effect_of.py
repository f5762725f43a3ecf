#!/usr/bin/python3
"""Prints the effect of a scene jobs/effect_<name>.json: the section that its name begins with.

  jobs/effect_of.py jobs/effect_stick_elastica.json      prints stick
"""
import json
import pathlib
import sys

if len(sys.argv) != 2 or sys.argv[1] == "--help":
    sys.exit(__doc__)
scene = pathlib.Path(sys.argv[1])
name = scene.stem.removeprefix("effect_")
print(max((section for section in json.loads(scene.read_text(encoding="utf-8")) if name.startswith(section)), key=len))

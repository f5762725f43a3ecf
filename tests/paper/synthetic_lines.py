"""Lines whose motions, displacements, regions and triggers are prescribed."""
import os
import pathlib
import sys
import unittest
from typing import NamedTuple

import numpy as np

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "analysis")]

from paper.atlas_lines import AtlasLines  # noqa: E402
from paper.judgement import judge  # noqa: E402
from paper.line import ABSENT, APERIODIC, NOT_COVERED, PRESENT, Line, Region, Trigger  # noqa: E402

CHAOS = APERIODIC


class Piece(NamedTuple):
    """From the end of the piece before (or the start of the line) up to and including `to`."""

    to: float  # Ω
    motion: tuple[int, ...]  # classes, repeated along the piece
    displacement: float  # [m]; a pair: from, to
    region: int = 0  # of which it is a part; 0: of none


def _region(number, speed, motion, displacement, region):
    inside = region == number
    if not inside.any():
        return Region(ABSENT)
    return Region(PRESENT, speed[inside][0], speed[inside][-1], float(np.mean(motion[inside] == CHAOS)),
                  displacement[inside].max(), float(np.median(displacement[inside])))


def line_of(pieces, triggers=(None, None), start=0.05, count=901, **fields):
    """A line with a trigger at each speed that is given."""
    speed = np.linspace(start, pieces[-1].to, count)
    piece = np.searchsorted([one.to + 1e-12 for one in pieces], speed)
    motion, displacement, region = np.zeros(count, "u1"), np.zeros(count), np.zeros(count, int)
    for i, one in enumerate(pieces):
        inside = np.flatnonzero(piece == i)
        motion[inside] = np.resize(one.motion, inside.size)
        displacement[inside] = np.linspace(*np.broadcast_to(one.displacement, 2), inside.size)
        region[inside] = one.region
    line = Line(speed, motion, displacement, blades=fields.pop("blades", 3))
    found = [Trigger(ABSENT) if place is None else
             Trigger(PRESENT, place, 1e-3, line.growth(displacement, place)) for place in triggers]
    return Line(**{**vars(line), "triggers": found, **fields,
                   "regions": [_region(k, speed, motion, displacement, region) for k in (1, 2, 3, 4)]})


def unknown_line(count=901):
    """A line of which no point is done."""
    return Line(np.linspace(0.05, 0.95, count), np.zeros(count, "u1"), np.full(count, np.nan),
                [Region(NOT_COVERED)] * 4, [Trigger(NOT_COVERED)] * 2)


def four_regions(**changes):
    """The paper's picture: small periodic motion to 1/3, chaos with windows to 0.55, period 1 to 2/3, chaos."""
    parts = {1: Piece(1 / 3, (1,), 1e-4, 1), 2: Piece(0.55, (CHAOS,) * 4 + (3,), 1e-2, 2),
             3: Piece(2 / 3, (1,), 5e-3, 3), 4: Piece(0.95, (CHAOS,), 2e-2, 4)}
    return [changes.get(f"region_{number}", part) for number, part in parts.items()]


NOTHING_HAPPENS = [Piece(0.95, (1,), 1e-5)]
AT_THIRDS = (1 / 3, 2 / 3)


SCENE = {"rotor": {"mass": 1.0, "natural_frequency": 10.0, "misalignment": 0.01001, "damping_ratio": 0.1},
         "blades": {"count": 3, "length": 0.1, "width": 0.01, "youngs_modulus": 206e9, "hub_radius": 0.0,
                    "thickness": 1e-3},
         "ring": {"radius": 0.11}, "contact": {"law": "elastica", "friction": 0.1}, "sweep": "up", "title": "synthetic"}
RIG_SCENE = {**SCENE,
             "rotor": {"mass": 0.5, "natural_frequency": 189.9406918360389, "misalignment": 0.36e-3,
                       "damping_ratio": 0.05},
             "blades": {"count": 3, "length": 0.04, "width": 0.0127, "youngs_modulus": 206e9, "hub_radius": 0.02215,
                        "thickness": 0.5e-3},
             "ring": {"radius": 0.0625}}
USUAL = {"thickness": 1e-3, "unbalance": 0.0, "friction": 0.1, "damping_ratio": 0.1}
RIG_USUAL = {**USUAL, "thickness": 0.5e-3, "damping_ratio": 0.05}


class SyntheticAtlas(AtlasLines):
    """An atlas whose lines are given, each with its values on the axes."""

    def __init__(self, scene, axes, usual=None):
        """`axes`: those beside the four of every atlas, slowest first."""
        # pylint: disable=super-init-not-called
        self.path, self.scene, self.usual = "synthetic.h5", scene, usual or USUAL
        self.names = [*axes, *USUAL]
        self.lines = []  # in the place of what is read
        self._units = {name: "-" for name in self.names} | {"thickness": "m", "unbalance": "kg m"}

    def add(self, line, **at):
        parameters = {name: at.get(name, self.usual.get(name, 0.0)) for name in self.names}
        self.lines.append(Line(**{**vars(line), "parameters": parameters, "blades": self.scene["blades"]["count"]}))
        self.values = {name: np.unique([one.parameters[name] for one in self.lines]) for name in self.names}
        return self

    has_spectra = False


def on_default(*axes, **sections):
    return SyntheticAtlas({**SCENE, **sections}, axes)


def on_rig(*axes, **sections):
    return SyntheticAtlas({**RIG_SCENE, **sections}, axes, RIG_USUAL)


class JudgementTest(unittest.TestCase):
    """A test that looks at verdicts on an atlas."""

    def judged(self, atlas, name):
        found = [one for one in judge(atlas) if one.name == name]
        self.assertTrue(found, name)
        return found

    def expect(self, atlas, **verdicts):
        for name, verdict in verdicts.items():
            found = self.judged(atlas, name)[0]
            self.assertEqual(found.verdict, verdict, (name, found.findings))

    def holds(self, atlas, name, claim):
        found = [finding.holds for finding in self.judged(atlas, name)[0].findings if finding.claim == claim]
        self.assertEqual(len(found), 1, claim)
        return found[0]

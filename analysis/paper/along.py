"""Findings along one parameter: what regions and triggers the lines have, and the picture that they make up."""
from collections.abc import Callable, Sequence

import numpy as np

from paper.line import ABSENT, MERGED, NOT_COVERED, PRESENT, Line, region_text, trigger_text
from paper.rotors import Evidence
from paper.verdict import SAME_PLACE, Finding, not_covered

NOMINAL_TRIGGER = (1.0 / 3.0, 2.0 / 3.0)  # scaled speeds


def has_all_four(line: Line) -> bool:
    return all(region.present for region in line.regions)


def picture(line: Line) -> str:
    """The regions and triggers that a line has: the whole picture. "regions 1 2 3 4, triggers 1 2"."""
    regions = "".join(f" {i}" for i, region in enumerate(line.regions, 1) if region.present)
    triggers = "".join(f" {i}" for i, trigger in enumerate(line.triggers, 1) if trigger.presence == PRESENT)
    return f"regions{regions or ' none'}, triggers{triggers or ' none'}"


def pictures(lines: Sequence[Line], place: Callable[[Line], str]) -> list[str]:
    """Each picture with the place from which on lines have it: one where it is the same on all."""
    found: list[str] = []
    before = ""
    for line in lines:
        now = picture(line)
        if now != before:
            found.append(f"{now} from {place(line)}")
        before = now
    return found


def all_four(evidence: Evidence, lines: Sequence[Line], name: str, claim: str) -> Finding:
    """Whether every line has all four regions: not covered where one might lie among points that are not done."""
    lacking, unknown = [], []
    for line in lines:
        lacks = [f"no region {i}" if region.presence == ABSENT else f"region {i} merged with 2"
                 for i, region in enumerate(line.regions, 1) if region.presence in (ABSENT, MERGED)]
        if lacks:
            lacking.append(f"{', '.join(lacks)} at {evidence.text(line, name)}")
        elif any(region.presence == NOT_COVERED for region in line.regions):
            unknown.append(evidence.text(line, name))
    brief = f"{len(lines) - len(lacking) - len(unknown)}/{len(lines)}"
    if lacking:
        return Finding(False, "; ".join(lacking), claim, brief)
    if unknown:
        return not_covered(f"not all regions are covered at {', '.join(unknown)}", claim)
    return Finding(True, f"all four regions {evidence.range_text(lines, name)}", claim, brief)


def region_there(line: Line, number: int) -> Finding:
    region, claim = line.regions[number - 1], f"region {number} is there"
    if region.presence == NOT_COVERED:
        return not_covered(region_text(number, region), claim)
    return Finding(region.present, region_text(number, region), claim,
                   f"{region.start:.2f}-{region.end:.2f}" if region.present else "")


def trigger_at_its_place(line: Line, number: int) -> Finding:
    """Whether a line has a trigger at 1/n (2/n)."""
    trigger, claim = line.triggers[number - 1], f"trigger {number} at {number}/n"
    text = trigger_text(number, trigger)
    if trigger.presence == NOT_COVERED:
        return not_covered(text, claim)
    if trigger.presence != PRESENT:
        return Finding(False, text, claim)
    scaled = line.scaled(trigger.speed)
    place = f"{3.0 * scaled:.3f}/n"
    return Finding(bool(abs(scaled - NOMINAL_TRIGGER[number - 1]) <= SAME_PLACE), f"{text}; {place}", claim, place)


def trigger_on_every(evidence: Evidence, lines: Sequence[Line], name: str, number: int, of: str) -> Finding:
    """Whether every line has it; `of` names the lines."""
    claim = f"{of}: trigger {number} at {number}/n"
    found = [(line, trigger_at_its_place(line, number).holds) for line in lines]
    departures = [f"{trigger_text(number, line.triggers[number - 1])} at {evidence.text(line, name)}"
                  for line, holds in found if holds is False]
    unknown = [evidence.text(line, name) for line, holds in found if holds is None]
    brief = f"{len(lines) - len(departures) - len(unknown)}/{len(lines)}"
    if departures:
        return Finding(False, "; ".join(departures), claim, brief)
    if unknown:
        return not_covered(f"trigger {number} is not covered at {', '.join(unknown)}", claim)
    places = [line.triggers[number - 1].speed for line in lines]
    return Finding(True, f"trigger {number} on every line, at {np.min(places):.3f}-{np.max(places):.3f}", claim, brief)


def same_picture(evidence: Evidence, lines: Sequence[Line], name: str, claim: str, matters: bool = False) -> Finding:
    """Whether lines have the same regions and triggers along one parameter; with `matters` whether they have not."""
    if any(region.presence == NOT_COVERED for line in lines for region in line.regions):
        return not_covered(f"not all regions are covered along {name}", claim)
    changes = pictures(lines, lambda line: evidence.text(line, name))
    return Finding((len(changes) > 1) == matters, "; ".join(changes), claim, f"{len(changes) - 1} changes")

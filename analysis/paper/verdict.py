"""A finding, the verdict that findings add up to, and the words that findings share."""
from typing import NamedTuple

# Distances in the scaled speed s = Ω n/3 (README of the folder above).
SAME_PLACE = 0.02  # "at": within this
NEXT_TO = 0.05  # "then", "locally": within this, one window of the running share
PERIODIC_SHARE = 0.05  # a region is periodic up to this share of aperiodic points
MAJORITY = 0.5  # a range of speeds is aperiodic from this share of aperiodic points on
SMALL = 0.1  # a displacement is small against another up to this ratio
NOTICEABLE = 0.1  # a displacement grows, or falls, where it changes by this share at least

AGREES, PARTLY, DISAGREES, NOT_COVERED = "agrees", "partly", "disagrees", "not covered"
JSON_KEY = "rubatlas_statements"  # of the files that `judge --json` writes


class Finding(NamedTuple):
    """One claim of a statement."""

    holds: bool | None  #: None: the atlas does not cover it
    evidence: str  #: the numbers that it rests on
    claim: str = ""  #: in words that are the same for every atlas: a row of the statement map
    brief: str = ""  #: the number for a cell of that map


def not_covered(reason: str, claim: str = "") -> Finding:
    return Finding(None, reason, claim)


def verdict_of(findings: list[Finding]) -> str:
    """What findings say of a statement: those that are not covered do not count."""
    holding = [finding.holds for finding in findings if finding.holds is not None]
    if not holding:
        return NOT_COVERED
    if all(holding):
        return AGREES
    return PARTLY if any(holding) else DISAGREES


def millimetres(metres: float) -> str:
    return f"{1e3 * metres:.3g} mm"

"""P5 to P8: how damping, friction and unbalance change the regions of the default rotor."""
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from paper.along import all_four, has_all_four
from paper.line import ABSENT, MERGED, NOT_COVERED, Line, Region, region_text
from paper.rotors import Evidence
from paper.verdict import MAJORITY, NEXT_TO, Finding, not_covered

LIKE_DAMPING = 0.15  # the whole picture is alike up to this damping ratio
SMALL_AREA = 0.01  # more aperiodic points in region 1, as a share, that make "small chaotic areas"
WIDTH = 0.02  # smallest change of a width in scaled speed that counts
CHAOTIC_FRICTION = (0.01, 0.2)
SMALL_UNBALANCE, GREATEST_UNBALANCE = 1e-5, 1e-4  # [kg m] the paper's values


class _Comparison(NamedTuple):
    """One number of a line, set against that of a reference line."""

    what: str
    claim: str
    value: Callable[[Line], float]
    sign: float  # +1: it should be greater than on the reference line, -1: smaller
    noticeable: float  # by this at least
    percent: bool = False


def _compared(evidence: Evidence, lines: Sequence[Line], reference: Line, wanted: _Comparison) -> Finding:
    """On the first of the lines on which the number is known: the width of a region that ends at a gap is not."""
    known = next((line for line in lines if np.isfinite(wanted.value(line))), None)
    there = wanted.value(reference)
    if known is None or not np.isfinite(there):
        return not_covered(f"{wanted.what}: not known on two lines", wanted.claim)
    here = wanted.value(known)
    one, other = (f"{number:.0%}" if wanted.percent else f"{number:.3f}" for number in (here, there))
    return Finding(bool(wanted.sign * (here - there) >= wanted.noticeable),
                   f"{wanted.what}: {one} at {evidence.text(known, 'damping_ratio')}, {other} at "
                   f"{evidence.text(reference, 'damping_ratio')}", wanted.claim, f"{one} / {other}")


def _aperiodic_extent(region: Region) -> float:
    """Width times share; 0 where the region is absent, NaN where not known."""
    return region.width * region.share if region.present else region.width


def damping(evidence: Evidence) -> dict[str, list[Finding]]:
    """P5a to c, P6: on lines along the damping ratio."""
    name, names = "damping_ratio", ("P5a", "P5b", "P5c", "P6")
    lines, nothing = evidence.lines_along(name, names)
    if nothing:
        return nothing
    inside = evidence.within(lines, name, 0.0, LIKE_DAMPING)
    reference = evidence.own_line or (inside[-1] if inside else None)
    if reference is None:
        return {one: [not_covered("no damping ratio up to 0.15")] for one in names}
    lower = [line for line in inside if evidence.value(line, name) < evidence.value(reference, name)]
    step = WIDTH * 3.0 / reference.blades
    none_lower = [not_covered("no damping ratio below that of the default rotor")]
    return {
        "P5a": [all_four(evidence, inside, name, "all four regions for ζ ≤ 0.15")],
        "P5b": [_compared(evidence, lower, reference,
                          _Comparison("width of region 2", "low ζ widens region 2",
                                      lambda line: line.regions[1].width, 1.0, step)),
                _compared(evidence, lower, reference,
                          _Comparison("width of region 3", "low ζ shortens region 3",
                                      lambda line: line.regions[2].width, -1.0, step))] if lower else none_lower,
        "P5c": [_compared(evidence, lower, reference,
                          _Comparison("aperiodic share of region 1", "low ζ: small aperiodic areas in region 1",
                                      lambda line: line.regions[0].share, 1.0, SMALL_AREA, True))]
        if lower else none_lower,
        "P6": _high_damping(evidence, lines[-1], reference, step)}


def _high_damping(evidence: Evidence, high: Line, reference: Line, step: float) -> list[Finding]:
    name = "damping_ratio"
    if not evidence.value(high, name) > LIKE_DAMPING * (1.0 + 1e-9):
        return [not_covered("no damping ratio above 0.15")]
    findings = []
    for number in (2, 4):
        def extent(line: Line, number: int = number) -> float:
            return _aperiodic_extent(line.regions[number - 1])
        findings.append(_compared(evidence, [high], reference,
                                  _Comparison(f"aperiodic part of region {number} (width × share)",
                                              f"high ζ attenuates region {number}", extent, -1.0, step)))
        # A region can vanish only if it exists on the line that high damping is compared with.
        now, before = high.regions[number - 1].presence, reference.regions[number - 1].presence
        gone = None if NOT_COVERED in (now, before) else now == ABSENT and before != ABSENT
        findings.append(Finding(gone, f"{region_text(number, high.regions[number - 1])} at "
                                f"{evidence.text(high, name)}, {'absent already' if before == ABSENT else 'there'} at "
                                f"{evidence.text(reference, name)}", f"high ζ: region {number} vanishes"))
    return findings


def _largest_shift(lines: Sequence[Line]) -> float:
    """Largest shift of a border of a region from line to line, in scaled speed."""
    places = np.array([[place for region in line.regions for place in (region.start, region.end)] for line in lines])
    return float(lines[0].scaled(np.ptp(places, axis=0).max()))


def _chaos_in_region_1(evidence: Evidence, lines: Sequence[Line], expected: bool, where: str) -> list[Finding]:
    if not lines:
        return []
    claim = f"{'' if expected else 'no '}aperiodic points in region 1 {where}"
    shares = [line.regions[0].share for line in lines]
    if not np.isfinite(shares).all():
        return [not_covered(f"aperiodic points in region 1 {where}: no region 1 on every line", claim)]
    text = ", ".join(f"{share:.1%} at {evidence.text(line, 'friction')}" for share, line in zip(shares, lines))
    return [Finding(all((share > 0.0) == expected for share in shares), f"aperiodic points in region 1 {where}: {text}",
                    claim)]


def friction(evidence: Evidence) -> dict[str, list[Finding]]:
    """P7: on lines along friction."""
    name = "friction"
    lines, nothing = evidence.lines_along(name, ["P7"])
    if nothing:
        return nothing
    findings = [all_four(evidence, lines, name, "all four regions at every μ")]
    if all(has_all_four(line) for line in lines):
        shift = _largest_shift(lines)
        findings.append(Finding(shift <= NEXT_TO, f"borders of the regions move by up to {shift:.3f}",
                                "μ moves borders only locally", f"{shift:.3f}"))
    inside = evidence.within(lines, name, *CHAOTIC_FRICTION)
    outside = [line for line in lines if not any(line is one for one in inside)]
    return {"P7": [*findings, *_chaos_in_region_1(evidence, inside, True, "for μ in [0.01, 0.2]"),
                   *_chaos_in_region_1(evidence, outside, False, "elsewhere")]}


def growth(evidence: Evidence, lines: Sequence[Line], what: str, claim: str, shows: Callable[[Line], bool | None],
           greatest: float = np.inf) -> Finding:
    """"Growing the unbalance": a property that the line of the least does not have, and one up to `greatest` has."""
    name = "unbalance"
    paper = evidence.within(lines, name, 0.0, greatest)
    if len(paper) < 2 or any(shows(line) is None for line in paper):
        return not_covered(f"{what}: not known for every unbalance on the grid"
                           f"{'' if np.isinf(greatest) else f' up to {greatest:g} kg m'}", claim)
    first = next((line for line in lines if shows(line)), None)
    if first is None:
        return Finding(False, f"{what}: never", claim, "never")
    already = first is lines[0]
    in_range = any(first is line for line in paper)
    return Finding(in_range and not already, f"{what}: {'already at' if already else 'from'} "
                   f"{evidence.text(first, name)}", claim, f"{evidence.value(first, name):.0e}")


def mostly_aperiodic(region: Region, share: float = MAJORITY) -> Callable[[Line], bool | None]:
    """Whether a line is aperiodic in at least this share of the place of a region."""
    def shows(line: Line) -> bool | None:
        found = line.aperiodic_share(region.start, region.end)
        return None if np.isnan(found) else bool(found >= share)
    return shows


def unbalance(evidence: Evidence) -> dict[str, list[Finding]]:
    """P8a to d: on lines along the unbalance."""
    name, names = "unbalance", ("P8a", "P8b", "P8c", "P8d")
    lines, nothing = evidence.lines_along(name, names)
    if nothing:
        return nothing
    small = evidence.within(lines, name, 0.0, SMALL_UNBALANCE)

    def without_trigger_2(line: Line) -> bool | None:
        presence = line.triggers[1].presence
        return None if presence == NOT_COVERED else presence == ABSENT

    def merged(line: Line) -> bool | None:
        presence = line.regions[3].presence
        return None if presence == NOT_COVERED else presence == MERGED

    place, chaotic = lines[0].regions[2], "growing me makes region 3 aperiodic"
    if place.present:
        region_3 = growth(evidence, lines, f"aperiodic in most of {place.start:.3f}-{place.end:.3f}, region 3 at "
                          f"{evidence.text(lines[0], name)}", chaotic, mostly_aperiodic(place), GREATEST_UNBALANCE)
    else:  # what is not there cannot become aperiodic
        region_3 = Finding(None if place.presence == NOT_COVERED else False, region_text(3, place), chaotic)
    return {
        "P8a": [all_four(evidence, small, name, "four regions for me ≤ 1e-5")] if small else
               [not_covered("no unbalance up to 1e-5 kg m")],
        "P8b": [growth(evidence, lines, "no trigger 2", "growing me removes trigger 2", without_trigger_2,
                       GREATEST_UNBALANCE)],
        "P8c": [region_3, growth(evidence, lines, "regions 2, 3 and 4 merged", "growing me merges 2, 3 and 4", merged,
                                 GREATEST_UNBALANCE)],
        "P8d": [_trigger_stays(evidence, lines)]}


def _trigger_stays(evidence: Evidence, lines: Sequence[Line]) -> Finding:
    """"Always": at every unbalance of the paper's range; departures beyond it are reported."""
    name, claim = "unbalance", "trigger 1 stays at every me"
    inside = evidence.within(lines, name, 0.0, GREATEST_UNBALANCE)
    if any(line.triggers[0].presence == NOT_COVERED for line in inside):
        return not_covered("trigger 1: the lines do not reach over it", claim)
    gone = {evidence.text(line, name): any(line is one for one in inside) for line in lines
            if line.triggers[0].presence == ABSENT}
    without = [text for text, in_range in gone.items() if in_range]
    beyond = [text for text, in_range in gone.items() if not in_range]
    after = f" (beyond: none at {', '.join(beyond)})" if beyond else ""
    if without:
        return Finding(False, f"no trigger 1 at {', '.join(without)}{after}", claim)
    return Finding(True, f"trigger 1 on every line up to 1e-4 kg m{after}", claim)

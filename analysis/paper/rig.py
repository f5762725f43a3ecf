"""P10 and P14: one line of the test rig, as computed and as measured.

    judged = rig.judge_line(line)  # {"P10": [finding, …], "P14a": …}

A line is plain arrays and regions (`line.Line`), so that thousands of rigs can be judged.
"""
import numpy as np

from paper.line import Line, course, if_covered, mostly, region_text, sudden_step, trigger_text
from paper.line import NOT_COVERED, PRESENT
from paper.verdict import NEXT_TO, SAME_PLACE, Finding, millimetres, not_covered

# A single speed of the paper stands for all points within this of it: it gives some speeds to two digits, and aperiodic
# motion has windows of single points.
AROUND = 0.005
ORBITS = {0.304: False, 0.4: True, 0.605: False, 0.74: True}  # Fig. 9: whether each is aperiodic

# P14, as measured.
REGION_1 = (0.137, 0.333)
CHAOS_IN_REGION_1 = 0.181
REGION_2 = (0.35, 0.55)
CHAOS_IN_REGION_3 = (0.55, 0.58)
REST_OF_REGION_3 = (0.58, 0.65)
REGION_4 = (0.65, 0.80)
DISPUTED = 0.72
STEP = (0.34, 0.35)
LEVER = 2.2  # displacement of the hub over that where the probes measure
PROBE_LIMIT = 0.72e-3  # [m] reading at which a probe saturates
SATURATION = LEVER * PROBE_LIMIT  # [m] displacement of the hub there


def _at_speed(line: Line, speed: float, aperiodic: bool) -> Finding:
    return mostly(line, speed - AROUND, speed + AROUND, aperiodic,
                  f"{'aperiodic' if aperiodic else 'periodic'} at {speed:.3f}")


def _border(line: Line, number: int, end: bool, measured: float) -> Finding:
    """Whether a border of a region lies within one window of the running share of the measured one."""
    region = line.regions[number - 1]
    claim = f"region {number} {'ends' if end else 'begins'} at {measured:.3f}"
    if not region.present:
        return Finding(if_covered(region.presence, False), region_text(number, region), claim)
    place = region.end if end else region.start
    return Finding(bool(abs(place - measured) <= NEXT_TO), region_text(number, region), claim, f"{place:.3f}")


def _saturated(line: Line) -> Finding:
    claim = f"saturated at {DISPUTED:.2f}"
    values = line.displacements(DISPUTED - AROUND, DISPUTED + AROUND)
    if values.size == 0:
        return not_covered(f"no point is done at {DISPUTED:g}", claim)
    median = float(np.median(values))
    return Finding(median >= SATURATION, f"displacement of the hub {millimetres(median)}; the probes saturate from "
                   f"{millimetres(SATURATION)} on", claim, millimetres(median))


def _step_of_trigger(line: Line) -> list[Finding]:
    trigger = line.triggers[0]
    claims = [f"trigger 1 at {STEP[0]:.2f}-{STEP[1]:.2f}", "the step there is instantaneous"]
    text = trigger_text(1, trigger)
    if trigger.presence == NOT_COVERED:
        return [not_covered(text, claim) for claim in claims]
    if trigger.presence != PRESENT:
        return [Finding(False, text, claim) for claim in claims]
    there = STEP[0] - SAME_PLACE <= trigger.speed <= STEP[1] + SAME_PLACE
    return [Finding(bool(there), text, claims[0], f"{trigger.speed:.3f}"), sudden_step(line, trigger.speed, claims[1])]


def _largest_at_the_beginning(line: Line) -> Finding:
    claim, region = "largest displacement of region 2 at its beginning", line.regions[1]
    if not region.present:
        return Finding(if_covered(region.presence, False), region_text(2, region), claim)
    inside = line.between(region.start, region.end) & np.isfinite(line.displacement)
    if not inside.any():
        return not_covered("no displacement is known in region 2", claim)
    place = float(line.speed[inside][np.argmax(line.displacement[inside])])
    first = place <= region.start + region.third
    return Finding(bool(first), f"region 2 at {region.start:.3f}-{region.end:.3f} has its largest displacement at "
                   f"{place:.3f}", claim, f"{place:.3f}")


def _step_into_region_4(line: Line) -> Finding:
    claim, region = "the step into region 4 is abrupt", line.regions[3]
    if not region.present:
        return Finding(if_covered(region.presence, False), region_text(4, region), claim)
    return sudden_step(line, region.start, claim)


def judge_line(line: Line) -> dict[str, list[Finding]]:
    """P10 and P14, letter by letter. "P14a1" and "P14a2" are two sentences on Ω = 0.72 that contradict each other."""
    return {
        "P10": [_at_speed(line, speed, aperiodic) for speed, aperiodic in ORBITS.items()],
        "P14a": [mostly(line, *REGION_1, False, "region 1 is mostly periodic"),
                 _border(line, 1, True, REGION_1[1]),
                 _at_speed(line, CHAOS_IN_REGION_1, True),
                 _border(line, 2, False, REGION_2[0]),
                 _border(line, 2, True, REGION_2[1]),
                 mostly(line, *CHAOS_IN_REGION_3, True, "aperiodic in 0.55-0.58"),
                 mostly(line, *REST_OF_REGION_3, False, "periodic in 0.58-0.65"),
                 _border(line, 4, False, REGION_4[0]),
                 mostly(line, *REGION_4, True, "aperiodic in most of 0.65-0.80")],
        "P14a1": [_at_speed(line, DISPUTED, False)],
        "P14a2": [_saturated(line)],
        "P14b": _step_of_trigger(line),
        "P14c": [_largest_at_the_beginning(line), course(line, 2, False, "displacement falls along region 2")],
        "P14d": [_step_into_region_4(line), course(line, 4, True, "displacement grows along region 4")],
    }

"""P1 to P4: the four regions and two triggers on one line of the default rotor. P2b is about the rig as well."""
import numpy as np

from paper.along import NOMINAL_TRIGGER, region_there, trigger_at_its_place
from paper.line import APERIODIC, NONE, UNRESOLVED, NOT_COVERED, PRESENT, Line, Numbers, if_covered, region_text
from paper.verdict import (MAJORITY, NEXT_TO, PERIODIC_SHARE, SAME_PLACE, SMALL, Finding, millimetres, not_covered)

EXACT = 0.005  # "exactly 2/3": half a digit of a speed with two digits
DOUBLING_SEARCH = 1.0 / 12.0  # as of triggers
ONE_KIND = 2  # neighbouring points that have a class make a kind of motion


def _region_1(line: Line) -> list[Finding]:
    region, trigger = line.regions[0], line.triggers[0]
    periodic = Finding(if_covered(region.presence, region.present and region.share <= PERIODIC_SHARE),
                       region_text(1, region), "region 1 is periodic", f"{region.share:.1%}" if region.present else "")
    return [periodic, trigger_at_its_place(line, 1)._replace(
        claim="trigger 1 at 1/3", brief=f"{trigger.speed:.3f}" if trigger.presence == PRESENT else "")]


def _kinds(motion: np.ndarray) -> list[str]:
    """The kinds of motion that at least ONE_KIND neighbouring points have."""
    runs = np.split(motion, np.flatnonzero(np.diff(motion)) + 1)
    kinds = {int(run[0]) for run in runs if run.size >= ONE_KIND and run[0] not in (NONE, UNRESOLVED)}
    return ["aperiodic" if kind == APERIODIC else f"period {kind}" for kind in sorted(kinds)]


def _small_and_varied(line: Line) -> list[Finding]:
    region = line.regions[0]
    beyond = line.regions[1] if line.regions[1].present else line.regions[2]
    small, varied = "region 1 is small", "several kinds of motion in region 1"
    if not region.present:
        return [Finding(if_covered(region.presence, False), region_text(1, region), claim) for claim in (small, varied)]
    kinds = _kinds(line.motion[line.between(region.start, region.end)])
    findings = [Finding(len(kinds) > 1, f"region 1 has {', '.join(kinds) or 'no motion of two neighbouring points'}",
                        varied, str(len(kinds)))]
    if not beyond.present:
        return [not_covered("no region after region 1 to compare with", small), *findings]
    ratio = region.median / beyond.median
    text = f"median displacement {millimetres(region.median)} in region 1, {millimetres(beyond.median)} in the next"
    return [Finding(bool(ratio <= SMALL), text, small, f"{ratio:.1e}"), *findings]


def _grows(what: str, values: Numbers, claim: str, number: str) -> Finding:
    """Whether a quantity grows along a range: medians of the first and last third of its points."""
    values = values[np.isfinite(values)]
    third = values.size // 3
    if third == 0:
        return not_covered(f"too few points to see how {what} goes on", claim)
    first, last = float(np.median(values[:third])), float(np.median(values[-third:]))
    return Finding(last > first, f"{what}: median {number.format(first)} in the first third of the points from 1/3 to "
                   f"region 2, {number.format(last)} in the last", claim, f"×{last / first:.2g}" if first else "")


def _goes_on(line: Line) -> list[Finding]:
    """P2a: from about 1/3 on to region 2."""
    there, region = region_there(line, 2), line.regions[1]
    if not region.present:
        return [there]
    begin = NOMINAL_TRIGGER[0] * 3.0 / line.blades
    if line.triggers[0].presence == PRESENT:
        begin = line.triggers[0].speed
    gap = line.scaled(region.start - begin)
    between = line.between(begin, region.start) & (line.speed < region.start)
    share = line.aperiodic_share(begin, np.nextafter(region.start, 0.0))
    goes_on = "periodic motion goes on beyond 1/3"
    if np.isnan(share) or gap <= SAME_PLACE:
        periodic = Finding(False, f"region 2 begins {gap:.3f} above {begin:.3f}", goes_on, f"{gap:+.3f}")
    else:
        periodic = Finding(share <= PERIODIC_SHARE, f"{share:.0%} aperiodic from {begin:.3f} to region 2, which begins "
                           f"{gap:.3f} higher", goes_on, f"{gap:+.3f}")
    findings = [there, periodic]
    if gap > SAME_PLACE:
        findings.append(_grows("displacement [m]", line.displacement[between], "displacement grows up to region 2",
                               "{:.3g}"))
        force = line.rows("max_contact_force")
        claim = "force grows up to region 2"
        findings.append(not_covered("the atlas keeps no max_contact_force", claim) if force is None else
                        _grows("force [N]", force[between], claim, "{:.3g}"))
    windows = region.share < 1.0
    findings.append(Finding(bool(windows), f"region 2 {'with' if windows else 'without'} periodic windows",
                            "region 2 has periodic windows", f"{1.0 - region.share:.0%}"))
    return findings


def sudden_jumps(line: Line) -> list[Finding]:
    """P2b: chaos begins at 1/3 and at 2/3, from periodic motion, without a stretch in which both alternate."""
    findings = []
    for number, place in ((2, "1/3"), (4, "2/3")):
        region = line.regions[number - 1]
        at, sudden = f"chaos begins at {place}", f"the jump into region {number} is sudden"
        if not region.present:
            findings += [Finding(if_covered(region.presence, False), region_text(number, region), claim)
                         for claim in (at, sudden)]
            continue
        off = line.scaled(region.start) - NOMINAL_TRIGGER[number // 2 - 1]
        text = f"region {number} begins at {region.start:.3f}, {off:+.3f} from {place} in scaled speed"
        findings.append(Finding(bool(abs(off) <= SAME_PLACE), text, at, f"{off:+.3f}"))
        step = SAME_PLACE * 3.0 / line.blades
        below = line.aperiodic_share(region.start - step, np.nextafter(region.start, 0.0))
        above = line.aperiodic_share(region.start, region.start + step)
        text = f"{below:.0%} aperiodic within {step:.2g} below {region.start:.3f}, {above:.0%} within that above"
        findings.append(not_covered(f"no points within {step:.2g} below {region.start:.3f}", sudden)
                        if np.isnan(below + above) else
                        Finding(bool(below <= PERIODIC_SHARE and above >= MAJORITY), text, sudden,
                                f"{below:.0%} / {above:.0%}"))
    return findings


def _region_3(line: Line) -> list[Finding]:
    region = line.regions[2]
    return [Finding(if_covered(region.presence, region.present and region.share <= PERIODIC_SHARE),
                    region_text(3, region), "region 3 is there and periodic",
                    f"{region.start:.2f}-{region.end:.2f}" if region.present else "")]


def _region_4(line: Line) -> list[Finding]:
    there, region = region_there(line, 4), line.regions[3]
    if region.presence == NOT_COVERED:
        return [there]
    claims = ["a period doubles at 2/3", "it does so at exactly 2/3"]
    off = {speed: line.scaled(speed) - NOMINAL_TRIGGER[1] for speed, _ in line.doublings}
    near = [one for one in line.doublings if abs(off[one[0]]) <= DOUBLING_SEARCH]
    if not near:
        step = float(np.diff(line.speed).mean())
        text = f"no period doubling seen near 2/3 in {line.doublings_in}, on speeds {step:.4f} apart"
        return [there, *(Finding(False, text, claim) for claim in claims)]
    speed, period = min(near, key=lambda one: abs(off[one[0]]))
    text = f"period {period} doubles at {speed:.3f} in {line.doublings_in}, {off[speed]:+.3f} from 2/3"
    findings = [there, *(Finding(abs(off[speed]) <= most, text, claim, f"{speed:.3f}")
                         for claim, most in zip(claims, (SAME_PLACE, EXACT)))]
    if region.present:
        gap = line.scaled(region.start - speed)
        findings.append(Finding(bool(-SAME_PLACE <= gap <= NEXT_TO), f"aperiodic motion begins {gap:.3f} above it",
                                "aperiodic motion follows the doubling", f"{gap:+.3f}"))
    return findings


def judge_line(line: Line) -> dict[str, list[Finding]]:
    return {"P1a": _region_1(line), "P1b": _small_and_varied(line), "P2a": _goes_on(line), "P2b": sudden_jumps(line),
            "P3": _region_3(line), "P4": _region_4(line)}

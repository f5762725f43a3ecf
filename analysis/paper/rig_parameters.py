"""P9, P15, P17 to P20 and P23: the test rig along thickness, clearance, damping, unbalance, the setting of its blades
and a speed that wanders."""
import itertools
from collections.abc import Callable, Sequence

import numpy as np

from paper.along import pictures, same_picture, trigger_on_every
from paper.line import ABSENT, MERGED, NOT_COVERED, PRESENT, Line, Region, region_text
from paper.parameters import growth, mostly_aperiodic
from paper.rig import CHAOS_IN_REGION_3
from paper.rotors import RIG, RIG_CLEARANCE, Evidence
from paper.verdict import NEXT_TO, PERIODIC_SHARE, SAME_PLACE, Finding, millimetres, not_covered

THIN = 0.4e-3  # [m] blades below this are thin
MILLIMETRE_BLADE = 1e-3  # [m] the thickness of P20
YIELD_STRAIN = 0.002  # bending strain up to which structural steel has yielded: 412 MPa if elastic
MORE = 1.5  # a force or strain is greater where it is by this factor
CLEARANCE_LOSS = 0.1e-3  # [m] that the blades lost over the paper's experiments
MOST_WANDERING = 0.111  # amplitude of the speed: 166.7 of 1500 rpm
SHARE_CHANGES = 0.1  # an aperiodic share changes by this at least

THICKNESS, DAMPING, UNBALANCE = "thickness", "damping_ratio", "unbalance"
MISALIGNMENT, RADIUS, LENGTH = "rotor_misalignment", "ring_radius", "blades_length"
WANDERING = "speed_ripple_amplitude"


def _is_thin(evidence: Evidence, line: Line) -> bool:
    return evidence.value(line, THICKNESS) < THIN * (1.0 - 1e-9)


def _no_thin_blades(evidence: Evidence) -> str:
    """The reason why statements on the thickness are not covered; empty where blades can bend."""
    if evidence.other_rotor:
        return evidence.other_rotor
    return "rigid blades have no thickness" if evidence.law == "elastic_ring" else ""


def _gone(evidence: Evidence, lines: Sequence[Line], number: int) -> Finding:
    """Whether an aperiodic region is absent on every line."""
    claim = f"h < 0.4 mm: no region {number}"
    regions = [(line, line.regions[number - 1]) for line in lines]
    there = [f"{region_text(number, region)} at {evidence.text(line, THICKNESS)}" for line, region in regions
             if region.presence in (PRESENT, MERGED)]
    absent = sum(region.presence == ABSENT for _, region in regions)
    brief, spread = f"{absent}/{len(lines)}", evidence.range_text(lines, THICKNESS)
    if there:
        return Finding(False, "; ".join(there), claim, brief)
    if absent < len(lines):
        return not_covered(f"region {number} is not covered {spread}", claim)
    return Finding(True, f"region {number} absent {spread}", claim, brief)


def thin_blades(evidence: Evidence) -> dict[str, list[Finding]]:
    """P9a and b: on lines along the thickness."""
    reason = _no_thin_blades(evidence)
    lines = [] if reason else evidence.lines_over(THICKNESS)
    thin = [line for line in lines if _is_thin(evidence, line)]
    thick = [line for line in lines if not _is_thin(evidence, line)]
    if not thin or not thick:
        reason = reason or "the grid has no blades of the test rig under 0.4 mm and from there on"
        return {"P9a": [not_covered(reason)], "P9b": [not_covered(reason)]}
    findings, own = [], evidence.own_line or thick[0]
    for number in (2, 4):  # a region can vanish only if it exists for thick blades
        region, claim = own.regions[number - 1], f"0.5 mm: region {number} is there"
        findings.append(Finding(None if region.presence == NOT_COVERED else region.presence in (PRESENT, MERGED),
                                f"{region_text(number, region)} at {evidence.text(own, THICKNESS)}", claim))
        findings.append(_gone(evidence, thin, number))
    return {"P9a": findings,
            "P9b": [trigger_on_every(evidence, thin, THICKNESS, number, "h < 0.4 mm") for number in (1, 2)]}


def _matters(evidence: Evidence, lines: Sequence[Line], thin: bool, what: str,
             value: Callable[[Line], str]) -> Finding:
    """Whether lines of one thickness have the same regions and triggers along another quantity: at none of the thick
    ones, at some of the thin ones."""
    claim = f"h {'<' if thin else '='} {0.4 if thin else 0.5} mm: {what} {'matters' if thin else 'does not matter'}"
    texts, compared, changed = [], 0, 0
    for thickness, group in itertools.groupby(lines, key=lambda line: evidence.value(line, THICKNESS)):
        own = list(group)
        wanted = _is_thin(evidence, own[0]) if thin else np.isclose(thickness, RIG.usual[THICKNESS], rtol=1e-9)
        if not wanted or len(own) < 2:
            continue
        found = pictures(own, value)
        compared += 1
        changed += len(found) > 1
        texts.append(f"h = {millimetres(thickness)}: {'; '.join(found)}")
    if compared == 0:
        return not_covered(f"no two values of {what} on the grid", claim)
    return Finding(changed > 0 if thin else changed == 0, f"{what}: {'. '.join(texts)}", claim,
                   f"{changed}/{compared} change")


def _clearance(evidence: Evidence, line: Line) -> float:
    """δc [m] of a line."""
    blades = evidence.scene["blades"]
    return evidence.value(line, RADIUS) - blades["hub_radius"] - evidence.value(line, LENGTH)


def _reach(evidence: Evidence, line: Line) -> float:
    """y0 − δc [m], by which blades reach into the ring from rest; where it is not above 0, nothing touches then."""
    return evidence.value(line, MISALIGNMENT) - _clearance(evidence, line)


def what_matters(evidence: Evidence) -> dict[str, list[Finding]]:
    """P15a and b. First contact is the reach; where nothing touches from rest, nothing is compared."""
    reason = _no_thin_blades(evidence)
    if reason:
        return {"P15a": [not_covered(reason)], "P15b": [not_covered(reason)]}

    own = RIG.quantities["/rotor/misalignment"] - RIG_CLEARANCE
    moved = [line for line in evidence.lines_over(THICKNESS, MISALIGNMENT) if _reach(evidence, line) > 0.0]
    # Radius and misalignment of the ring grow by the same amount: the blades overlap the ring as before.
    widened = [line for line in evidence.lines_over(THICKNESS, RADIUS, MISALIGNMENT)
               if abs(_reach(evidence, line) - own) <= 1e-3 * own]
    damped = evidence.lines_over(THICKNESS, DAMPING)

    def of(thin: bool) -> list[Finding]:
        return [_matters(evidence, widened, thin, "clearance with y0 = δc + 0.01 mm",
                         lambda line: f"δc = {millimetres(_clearance(evidence, line))}"),
                _matters(evidence, moved, thin, "misalignment (first contact)" if thin else "misalignment",
                         lambda line: f"y0 = {millimetres(evidence.value(line, MISALIGNMENT))}")]
    return {"P15a": of(False),
            "P15b": [*of(True), _matters(evidence, damped, True, "damping",
                                         lambda line: f"ζ = {evidence.value(line, DAMPING):g}")]}


def chaos_by_unbalance(evidence: Evidence) -> dict[str, list[Finding]]:
    """P17: on lines along the unbalance."""
    lines, nothing = evidence.lines_along(UNBALANCE, ["P17"])
    if nothing:
        return nothing
    low, high = CHAOS_IN_REGION_3
    measured = mostly_aperiodic(Region(PRESENT, low, high))
    if evidence.value(lines[0], UNBALANCE) > 0.0:
        return {"P17": [not_covered("the grid has no line of the rig without unbalance")]}
    share, chaos = lines[0].aperiodic_share(low, high), f"{low:.2f}-{high:.2f}"
    without = not_covered(f"no point is done in {chaos}") if np.isnan(share) else \
        Finding(bool(share <= PERIODIC_SHARE), f"{share:.0%} aperiodic in {chaos} without unbalance",
                f"periodic in {chaos} without unbalance", f"{share:.0%}")
    findings = [without, growth(evidence, lines, f"aperiodic in most of {chaos}", f"growing me makes {chaos} aperiodic",
                                measured)]
    region, claim = lines[0].regions[2], "growing me makes part of region 3 aperiodic"
    if region.present:
        part = region.share + SHARE_CHANGES
        findings.append(growth(evidence, lines, f"{part:.0%} or more aperiodic in {region.start:.3f}-{region.end:.3f}, "
                               f"region 3 without unbalance", claim, mostly_aperiodic(region, part)))
    else:
        findings.append(not_covered(region_text(3, region), claim))
    return {"P17": findings}


def _differs(one: Region, other: Region, line: Line) -> bool:
    """Whether a region is there on one line alone, or has other borders or another aperiodic share."""
    if one.presence != other.presence:
        return True
    if not one.present:
        return False
    shift = line.scaled(max(abs(one.start - other.start), abs(one.end - other.end)))
    return shift > NEXT_TO or abs(one.share - other.share) > SHARE_CHANGES


def repeated(evidence: Evidence) -> dict[str, list[Finding]]:
    """P18: along the setting of the blades, the misalignment and the loss of material, regions 1, 2 and 4 and both
    triggers are as on the rig's own line; region 3 differs somewhere. Of blades that reach the ring from rest."""
    axes = [name for name in evidence.atlas.names if evidence.atlas.values[name].size > 1 and
            (name.startswith("unequal_blades_") or name in (MISALIGNMENT, RADIUS, LENGTH))]
    own = evidence.own_line
    if own is None or not axes:
        return {"P18": [not_covered(evidence.no_own_line() if own is None else
                                    "the grid sweeps no setting of the blades, misalignment or length")]}
    others = [line for line in evidence.lines_over(*axes) if line is not own and _reach(evidence, line) > 0.0]
    if not others:
        return {"P18": [not_covered("no blades but the rig's own reach the ring from rest")]}
    names = {"unequal_blades_length_spread": "spread of the lengths", MISALIGNMENT: "y0", RADIUS: "R", LENGTH: "L"}

    def place(line: Line) -> str:
        return ", ".join(evidence.text(line, name).replace(name, names.get(name, name)) for name in axes)
    findings = []
    for number in (1, 2, 4, 3):
        differing = [place(line) for line in others
                     if _differs(line.regions[number - 1], own.regions[number - 1], line)]
        keeps = number != 3
        claim = f"region {number} stays as it is" if keeps else "region 3 differs"
        text = f"region {number} differs on {len(differing)} of {len(others)} lines along {', '.join(axes)}"
        findings.append(not_covered(region_text(number, own.regions[number - 1]), claim)
                        if own.regions[number - 1].presence == NOT_COVERED else
                        Finding((not differing) == keeps, text + (f": {'; '.join(differing[:3])}" if differing else ""),
                                claim, f"{len(differing)}/{len(others)}"))
    for number in (1, 2):
        there = own.triggers[number - 1]
        kept = [line.triggers[number - 1].presence == there.presence and
                not abs(line.scaled(line.triggers[number - 1].speed - there.speed)) > SAME_PLACE for line in others]
        findings.append(Finding(all(kept), f"trigger {number} as on the rig's own line on {sum(kept)} of {len(kept)} "
                                "lines", f"trigger {number} stays as it is", f"{sum(kept)}/{len(kept)}"))
    return {"P18": findings}


def contact_of_worn_blades(evidence: Evidence) -> dict[str, list[Finding]]:
    """P19: blades that are 0.1 mm shorter, or a ring that much wider, touch with an unbalance and not without."""
    reason = evidence.other_rotor
    worn = [line for line in evidence.lines_over(UNBALANCE, RADIUS, LENGTH)
            if abs(_clearance(evidence, line) - RIG_CLEARANCE - CLEARANCE_LOSS) <= 1e-9 and line.contact is not None]
    if reason or not worn:
        return {"P19": [not_covered(reason or "the grid has no line with a clearance that is 0.1 mm wider")]}
    findings = []
    for unbalanced, claim in ((False, "no contact without unbalance"), (True, "contact with unbalance")):
        lines = [line for line in worn if (evidence.value(line, UNBALANCE) > 0.0) == unbalanced]
        if not lines:
            findings.append(not_covered(f"no worn line {'with' if unbalanced else 'without'} unbalance", claim))
            continue
        shares = [float(np.mean(line.contact[line.contact > 0] == 2)) if (line.contact > 0).any() else np.nan
                  for line in lines if line.contact is not None]
        text = ", ".join(f"{share:.0%} of the speeds at me = {evidence.value(line, UNBALANCE):g} kg m"
                         for share, line in zip(shares, lines))
        holds = max(shares) > 0.0 if unbalanced else max(shares) == 0.0
        findings.append(Finding(bool(holds), f"contact at {text}", claim, f"{max(shares):.0%}"))
    return {"P19": findings}


def strength(evidence: Evidence) -> dict[str, list[Finding]]:
    """P20: force, strain of the root and stress with blades of 1 mm, against those of 0.5 mm."""
    reason = _no_thin_blades(evidence)
    by_thickness = {round(evidence.value(line, THICKNESS), 9): line for line in evidence.lines_over(THICKNESS)}
    thick, own = by_thickness.get(MILLIMETRE_BLADE), by_thickness.get(RIG.usual[THICKNESS])
    if reason or thick is None:
        return {"P20": [not_covered(reason or "the grid has no blades of 1 mm")]}

    def largest(line: Line | None, name: str) -> float:
        values = None if line is None else line.rows(name)
        return np.nan if values is None or not np.isfinite(values).any() else float(np.nanmax(values))
    strain, force = largest(thick, "max_root_strain"), largest(thick, "max_contact_force")
    findings = []
    if np.isnan(strain):
        findings.append(not_covered("the atlas keeps no max_root_strain", "1 mm: a blade's root yields"))
    else:
        stress = 1e-6 * strain * evidence.scene["blades"]["youngs_modulus"]
        findings.append(Finding(strain > YIELD_STRAIN, f"bending strain of the root up to {strain:.2%}, "
                                f"{stress:.0f} MPa if elastic; structural steel yields below {YIELD_STRAIN:.1%}",
                                "1 mm: a blade's root yields", f"{strain:.2%}"))
    for name, value, unit in (("max_root_strain", strain, ""), ("max_contact_force", force, " N")):
        claim = f"1 mm: larger {name.replace('max_', '').replace('_', ' ')} than at 0.5 mm"
        other = largest(own, name)
        findings.append(not_covered(f"{name} is not known at 1 mm and 0.5 mm", claim) if np.isnan(value + other) else
                        Finding(value >= MORE * other, f"{value:.3g}{unit} at 1 mm, {other:.3g}{unit} at 0.5 mm", claim,
                                f"×{value / other:.2g}"))
    return {"P20": findings}


def wandering(evidence: Evidence) -> dict[str, list[Finding]]:
    """P23: what the computation, which holds the speed constant, leaves out."""
    lines, nothing = evidence.lines_along(WANDERING, ["P23"])
    if nothing:
        return nothing
    inside = evidence.within(lines, WANDERING, 0.0, MOST_WANDERING)
    return {"P23": [same_picture(evidence, inside, WANDERING, "the whole picture stays while the speed wanders by "
                                 "up to 166.7 of 1500 rpm")]}

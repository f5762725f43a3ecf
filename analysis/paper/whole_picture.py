"""P12, P13, P21, P22 and P24: what regions and triggers say as a whole."""
import numpy as np

from paper.along import all_four, has_all_four, picture, region_there, same_picture, trigger_at_its_place
from paper.along import trigger_on_every
from paper.line import NOT_COVERED, UNRESOLVED, Line, region_text
from paper.rotors import Evidence
from paper.verdict import Finding, millimetres, not_covered

SMALL_CHANGE = 0.3  # a parameter changes little up to this share of its value
# Lengths that are large beside the hundredth of a millimetre by which blades reach into the ring.
NO_SMALL_CHANGE = ("direction", "rotor_misalignment", "ring_radius", "blades_length", "blades_hub_radius")
RANGES = {"damping_ratio": 0.15, "friction": 0.2}  # P22: up to these values


def blade_count(evidence: Evidence) -> dict[str, list[Finding]]:
    """P12: the default rotor with another number of blades."""
    line = evidence.own_line
    if line is None or line.blades == 3:
        return {"P12": [not_covered(evidence.no_own_line() if line is None else
                                    "the rotor has the three blades of the default rotor")]}
    return {"P12": [*(trigger_at_its_place(line, number) for number in (1, 2)),
                    *(region_there(line, number) for number in (1, 2, 3, 4))]}


def ring_stiffness(evidence: Evidence) -> dict[str, list[Finding]]:
    """P13: along the stiffness of a massless ring."""
    name = "ring_stiffness"
    lines = evidence.lines_over(name)
    if evidence.other_rotor or evidence.law != "elastic_ring" or len(lines) < 2:
        return {"P13": [not_covered(evidence.other_rotor or
                                    "the grid has no axis /ring/stiffness under the law elastic_ring")]}
    complete = [evidence.text(line, name) for line in lines if has_all_four(line)]
    known = all(region.presence != NOT_COVERED for line in lines for region in line.regions)
    some = Finding(bool(complete) or (False if known else None),
                   f"all four regions at {', '.join(complete) or 'no stiffness'}", "all four regions at some stiffness",
                   f"{len(complete)}/{len(lines)}")
    return {"P13": [some, all_four(evidence, lines, name, "all four regions at every stiffness"),
                    *(trigger_on_every(evidence, lines, name, number, "stiffness") for number in (1, 2))]}


def small_changes(evidence: Evidence) -> dict[str, list[Finding]]:
    """P21: on each pair of neighbouring lines that differ little in one parameter."""
    if evidence.other_rotor:
        return {"P21": [not_covered(evidence.other_rotor)]}
    pairs = kept = changed = 0
    differing = []
    for name in evidence.atlas.names:
        if name in NO_SMALL_CHANGE or evidence.atlas.values[name].size < 2:
            continue
        lines = evidence.lines_over(name)
        for one, other in zip(lines, lines[1:]):
            low, high = evidence.value(one, name), evidence.value(other, name)
            if not 0.0 < high - low <= SMALL_CHANGE * abs(low):
                continue
            pairs += 1
            settled = [(line.motion != 0) & (line.motion != UNRESOLVED) for line in (one, other)]
            changed += bool((one.motion != other.motion)[settled[0] & settled[1]].any())
            kept += picture(one) == picture(other)
            if picture(one) != picture(other):
                differing.append(f"{evidence.text(one, name)} and {evidence.text(other, name)}")
    if pairs == 0:
        return {"P21": [not_covered("the grid has no two lines that differ by 30 % or less of one parameter")]}
    return {"P21": [
        Finding(changed == pairs, f"motions differ on {changed} of {pairs} pairs of lines",
                "a small change of a parameter changes motions", f"{changed}/{pairs}"),
        Finding(kept == pairs, f"the whole picture stays on {kept} of {pairs} pairs of lines" +
                (f"; not between {'; '.join(differing[:3])}" if differing else ""),
                "a small change of a parameter keeps the whole picture", f"{kept}/{pairs}")]}


def ranges(evidence: Evidence) -> dict[str, list[Finding]]:
    """P22: the rig's picture is one and the same over the ranges of damping and friction."""
    if evidence.other_rotor:
        return {"P22": [not_covered(evidence.other_rotor)]}
    findings = []
    for name, most in RANGES.items():
        lines = evidence.within(evidence.lines_over(name), name, 0.0, most)
        claim = f"one picture for {'ζ' if name == 'damping_ratio' else 'μ'} up to {most:g}"
        findings.append(same_picture(evidence, lines, name, claim) if len(lines) > 1 else
                        not_covered(f"the grid has no two values of {name} up to {most:g}", claim))
    return {"P22": findings}


def where_to_operate(line: Line) -> dict[str, list[Finding]]:
    """P24: displacement and force of the periodic regions against those of the chaotic region above."""
    findings = []
    force = line.rows("max_contact_force")
    for calm, wild in ((1, 2), (3, 2), (3, 4)):
        here, there = line.regions[calm - 1], line.regions[wild - 1]
        for what, values, unit in (("displacement", line.displacement, "m"), ("force", force, "N")):
            claim = f"less {what} in region {calm} than in region {wild}"
            if values is None:
                findings.append(not_covered("the atlas keeps no max_contact_force", claim))
                continue
            if not (here.present and there.present):
                texts = [region_text(k, line.regions[k - 1]) for k in (calm, wild) if not line.regions[k - 1].present]
                findings.append(not_covered("; ".join(texts), claim))
                continue
            one, other = (float(np.nanmedian(values[line.between(region.start, region.end)]))
                          for region in (here, there))
            text = [millimetres(value) if unit == "m" else f"{value:.3g} N" for value in (one, other)]
            findings.append(Finding(one < other, f"median {what} {text[0]} in region {calm}, {text[1]} in {wild}",
                                    claim, f"×{one / other:.2g}" if other else ""))
    return {"P24": findings}

"""P11: the lines of the spectrum and what lies between them, measured by `rubatlas.signature`.

The rules: a spectrum is **broad** where at least a tenth of its power lies between the lines of whole orders, and there
over at least a fiftieth of the bins. A periodic motion has no power between the lines; a doubled period has it in a
five-hundredth of the bins of a hundred revolutions, white noise in half of them. A region is broad where half of its
points are. Its **centre** is the median centroid of these points.
"""
import numpy as np
import numpy.typing as npt
from rubatlas.signature import COARSEST, Signature, half_width, signature

from paper.line import TRIGGER_RISE, Line, Numbers, if_covered, region_text
from paper.verdict import MAJORITY, NEXT_TO, PERIODIC_SHARE, Finding, millimetres, not_covered

BROAD_SHARE = 0.1  # of the power, between the lines
BROAD_BREADTH = 0.02  # of the bins between the lines
NEAR = 0.25  # [orders] "close to" a frequency
STANDS = 0.01  # a line is there from this share of the highest amplitude on ...
ABOVE_BESIDE = 2.0  # ... where it is this many times what stands beside it


def signature_of(line: Line, orders: Numbers) -> tuple[Signature, Numbers] | None:
    """The signs at each speed, and the spectra; None where the atlas keeps none that can be measured."""
    spectra = line.rows("spectrum")
    if spectra is None or orders.size < 2 or orders[1] - orders[0] > COARSEST or orders[-1] < 2 * line.blades:
        return None
    return signature(orders, spectra, blades=line.blades), spectra


def is_broad(signs: Signature) -> npt.NDArray[np.bool_]:
    return (signs.between_share >= BROAD_SHARE) & (signs.breadth >= BROAD_BREADTH)


def has_line_at_1(orders: Numbers, spectra: Numbers, signs: Signature) -> npt.NDArray[np.bool_]:
    """Whether the 1× line stands out of what is beside it, from order 1/2 to 3/2."""
    half = half_width(orders[1] - orders[0])
    near = (np.abs(orders - 1.0) <= 0.5) & (np.abs(orders - np.rint(orders)) > half)
    highest = spectra[:, orders > half].max(axis=1)
    return (highest > 0.0) & (signs.rotation >= STANDS * highest) & (
        signs.rotation >= ABOVE_BESIDE * spectra[:, near].max(axis=1))


def _peak_of_the_passing_line(line: Line, orders: Numbers, signs: Signature, spectra: Numbers) -> list[Finding]:
    region, n = line.regions[1], line.blades
    claims = [f"the {n}× line steps up where region 2 begins", f"its peak up to the end of region 2 is at the "
              "beginning of region 2", f"at the peak the {n}× line is the highest"]
    if not region.present:
        return [Finding(if_covered(region.presence, False), region_text(2, region), claim) for claim in claims]
    step = line.growth(signs.passing, region.start)
    trigger = line.growth(signs.passing, line.triggers[0].speed)
    text = f"{n}× line ×{step:.3g} where region 2 begins ({region.start:.3f})"
    if np.isfinite(trigger):
        text += f", ×{trigger:.3g} at trigger 1 ({line.triggers[0].speed:.3f})"
    findings = [not_covered(text, claims[0]) if np.isnan(step) else
                Finding(bool(step >= TRIGGER_RISE), text, claims[0], f"×{step:.2g}")]
    inside = np.flatnonzero(line.between(line.speed[0], region.end) & np.isfinite(signs.passing))
    if inside.size == 0:
        return [findings[0], *(not_covered("no spectrum is known up to there", claim) for claim in claims[1:])]
    top = inside[np.argmax(signs.passing[inside])]
    place = float(line.speed[top])
    text = f"{n}× line largest at {place:.3f}, {1e3 * signs.passing[top]:.3g} mm; region 2 from {region.start:.3f} on"
    findings.append(Finding(bool(abs(line.scaled(place - region.start)) <= NEXT_TO), text, claims[1], f"{place:.3f}"))
    share = float(signs.passing[top] / spectra[top, orders > half_width(orders[1] - orders[0])].max())
    findings.append(Finding(share >= 1.0 - 1e-9, f"{n}× line {share:.0%} of the highest at {place:.3f}", claims[2],
                            f"{share:.0%}"))
    return findings


def _broad_region(line: Line, number: int, signs: Signature) -> tuple[Finding, Numbers | None]:
    """Whether a region is broad, and which of its points are."""
    region, claim = line.regions[number - 1], f"the spectrum is broad in region {number}"
    if not region.present:
        return Finding(if_covered(region.presence, False), region_text(number, region), claim), None
    inside = line.between(region.start, region.end) & np.isfinite(signs.between_share)
    if not inside.any():
        return not_covered(f"no spectrum is known in region {number}", claim), None
    broad = inside & is_broad(signs)
    share = broad.sum() / inside.sum()
    text = (f"region {number}: {share:.0%} of the points broad; median {np.median(signs.between_share[inside]):.0%} of "
            f"the power between the lines, over {np.median(np.nan_to_num(signs.breadth[inside])):.1%} of the bins")
    return Finding(bool(share >= MAJORITY), text, claim, f"{share:.0%}"), broad if broad.any() else None


def _centre(line: Line, number: int, signs: Signature, claim: str) -> list[Finding]:
    broad, points = _broad_region(line, number, signs)
    if points is None:
        return [broad, not_covered(f"nothing broad in region {number}", claim)]
    centre, width = np.median(signs.centroid[points]), np.median(signs.width[points])
    if number == 2:
        holds, text = 1.0 < centre < 2.0, f"centre {centre:.2f}×, width {width:.2f} orders"
    else:
        natural = float(np.median(1.0 / line.speed[points]))
        off = float(np.median(signs.centroid[points] - 1.0 / line.speed[points]))
        holds, text = abs(off) <= NEAR, (f"centre {centre:.2f}×, width {width:.2f} orders; {off:+.2f} orders from the "
                                         f"natural frequency, which is at {natural:.2f}×")
    return [broad, Finding(bool(holds), f"region {number}: {text}", claim, f"{centre:.2f}×")]


def judge_line(line: Line, orders: Numbers) -> dict[str, list[Finding]]:
    """P11a to c on one line."""
    measured = signature_of(line, orders)
    if measured is None:
        reason = "the atlas keeps no spectrum of eight revolutions or more that reaches twice the number of blades"
        return {name: [not_covered(reason)] for name in ("P11a", "P11b", "P11c")}
    signs, spectra = measured
    return {"P11a": _peak_of_the_passing_line(line, orders, signs, spectra),
            "P11b": _centre(line, 2, signs, "its centre is between the 1× and the 2× line"),
            "P11c": _centre(line, 4, signs, "its centre is close to the natural frequency")}


def announced(line: Line) -> list[Finding]:
    """P11e: the signs of `rubatlas analyse` against the speed at which displacement passes the limit named there."""
    claims = ["a sign stands before the displacement passes the limit", "no sign is false"]
    if not line.signs:
        return [not_covered("the maps have no /signature, which `rubatlas analyse` makes from spectra")]
    limit, at = line.signs["limit"], line.signs["limit_speed_ratio"]
    passed = f"the displacement passes {millimetres(limit)}"
    false = {name.removesuffix("_false").replace("_", " "): int(count) for name, count in line.signs.items()
             if name.endswith("_false") and not name.startswith("displacement")}
    listed = ", ".join(f"{name} {count}" for name, count in false.items())
    wrong = Finding(not any(false.values()), f"false signs: {listed}", claims[1], str(sum(false.values())))
    if np.isnan(at):
        return [not_covered(f"at no speed {passed}", claims[0]), wrong]
    first = line.signs["announced_speed_ratio"]
    if np.isnan(first):
        return [Finding(False, f"{passed} at {at:.3f}; no sign stands there", claims[0]), wrong]
    earlier = 1.0 - first / at
    return [Finding(bool(first < at), f"{passed} at {at:.3f}; the first sign that stands is at {first:.3f}, "
                    f"{earlier:.1%} of the speed earlier", claims[0], f"{earlier:.1%}"), wrong]


def line_at_1(lines: list[Line], orders: Numbers) -> list[Finding]:
    """P11d on lines along the unbalance: the 1× line is there with an unbalance, and not without."""
    shares: dict[bool, list[tuple[float, float]]] = {False: [], True: []}
    for line in lines:
        measured = signature_of(line, orders)
        if measured is None:
            continue
        known = np.isfinite(measured[0].rotation)
        if known.any():
            unbalance = line.parameters.get("unbalance", 0.0)
            there = has_line_at_1(orders, measured[1], measured[0])[known]
            shares[unbalance > 0.0].append((unbalance, float(there.mean())))
    findings = []
    for unbalanced, claim in ((False, "no 1× line without unbalance"), (True, "a 1× line with unbalance")):
        if not shares[unbalanced]:
            findings.append(not_covered(f"no spectrum {'with' if unbalanced else 'without'} an unbalance", claim))
            continue
        found = shares[unbalanced]
        most = max(share for _, share in found)
        holds = most >= MAJORITY if unbalanced else most <= PERIODIC_SHARE
        text = ", ".join(f"{share:.0%} of the points at me = {value:g} kg m" for value, share in found)
        findings.append(Finding(holds, f"1× line at {text}", claim, f"{most:.0%}"))
    return findings

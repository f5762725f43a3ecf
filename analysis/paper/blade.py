"""P16: Fig. 2, from the closed form of the rig's blade, without any motion."""
from typing import Any

import numpy as np
from rubatlas import elastica

from paper.verdict import Finding, not_covered

EULER_LOAD = 42.0  # [N] the paper's, to three digits
SMALL_LOAD = 0.05  # of the Euler load: "small F" means loads up to this one
EXPONENT = 0.1  # "linear", "quadratic": the exponent over the last halving of a small load is within this of 1, 2


def curve(blades: dict[str, Any], friction: float) -> list[Finding]:
    """Of blades as a scene has them."""
    rigidity = blades["youngs_modulus"] * blades["width"] * blades["thickness"] ** 3 / 12.0
    unit = rigidity / blades["length"] ** 2  # [N] the force that F L²/EI counts
    euler = unit * elastica.EULER_LOAD
    findings = [Finding(abs(euler - EULER_LOAD) < 0.05, f"Euler load {euler:.2f} N", "Euler load 42.0 N",
                        f"{euler:.2f} N")]
    if friction <= 0.0:
        return [*findings, not_covered("a column without friction stands straight up to the Euler load")]
    # The load grows with κ along the branch that begins at no load.
    load, shortening, deflection = elastica.curve(friction, np.geomspace(1e-6, 0.9, 2000))
    wanted = SMALL_LOAD * elastica.EULER_LOAD * np.array([0.5, 1.0])
    for what, values, power, word in (("δ", shortening, 2.0, "quadratic"), ("Δ", deflection, 1.0, "linear")):
        half, whole = np.exp(np.interp(np.log(wanted), np.log(load), np.log(values)))
        exponent = np.log2(whole / half)
        findings.append(Finding(
            bool(abs(exponent - power) <= EXPONENT),
            f"{what} grows as F^{exponent:.3f} from {unit * wanted[0]:.2f} to {unit * wanted[1]:.2f} N, where it is "
            f"{1e3 * blades['length'] * whole:.3g} mm (μ = {friction:g})", f"{what} {word} at small F",
            f"F^{exponent:.2f}"))
    return findings

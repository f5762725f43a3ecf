"""The blade as a large-deflection cantilever, in closed form, with numpy alone.

The program has its own elastica, in C++; this one is for drawing, and is tested against the same reference data. A
report's page draws blades from the table `angles_from_tip`.

With β = atan μ and the parameter κ from sin(β/2) (no load) to 1: sin(ψ/2) = κ sin χ along the blade, from χ0 at the
hub, sin χ0 = sin(β/2)/κ, to π/2 at the tip, and θ = ψ − β is the slope. Then

    q = ∫ dχ / sqrt(1 − κ² sin²χ),   F L²/EI = q² cos β,   δ/L = 1 − mean cos θ,   Δ/L = mean sin θ

which are the differences of Legendre's integrals (src/model.md, 3.2), written as one integral each: nothing cancels
near zero load. At μ = 0 the same formulas describe a column that stands straight up to the Euler load.
"""
import numpy as np

# Gauss and Legendre's nodes on [0, 1]; the integrands are smooth up to κ = 0.99, where δ/L is beyond 1.
_NODES, _WEIGHTS = 0.5 * np.array(np.polynomial.legendre.leggauss(100)) + [[0.5], [0.0]]

EULER_LOAD = np.pi**2 / 4  # of the clamped-free column, F L²/EI


def curve(friction, excess):
    """Load and tip deflection along the elastica, one entry per κ − sin(β/2) in `excess` (> 0).

    Returns F L²/EI, δ/L (axial shortening) and Δ/L (lateral deflection), all dimensionless.
    """
    excess = np.atleast_1d(np.asarray(excess, dtype=float))[:, np.newaxis]
    half_angle = 0.5 * np.arctan(friction)
    least = np.sin(half_angle)
    kappa = least + excess
    # α = π/2 − χ runs from 0 at the tip to `span` at the hub; cos(span) = least/κ, without cancellation.
    span = np.arctan2(np.sqrt(excess * (2.0 * least + excess)), least)
    alpha = span * _NODES
    sine = kappa * np.cos(alpha)
    cosine = np.sqrt(1.0 - sine**2)
    weight = span * _WEIGHTS / cosine
    q = np.sum(weight, axis=1, keepdims=True)
    # sin(θ/2) and cos(θ/2), θ/2 = ψ/2 − β/2; sin ψ/2 − sin β/2 is formed without cancellation.
    rise = excess * np.cos(alpha) - 2.0 * least * np.sin(0.5 * alpha) ** 2
    half_slope = 2.0 * np.arctan2(rise, cosine + np.cos(half_angle))
    shortening = np.sum(weight * 2.0 * np.sin(half_slope) ** 2, axis=1) / q[:, 0]
    deflection = np.sum(weight * np.sin(2.0 * half_slope), axis=1) / q[:, 0]
    return q[:, 0] ** 2 * np.cos(2.0 * half_angle), shortening, deflection


def up_to_shortening(friction, limit, count=400):
    """The curve from no load to δ/L = `limit` (at most 0.9), with points spaced so that it draws smoothly."""
    largest = 0.95 - np.sin(0.5 * np.arctan(friction))
    excess = largest * np.linspace(0.0, 1.0, 4 * count + 1)[1:] ** 3
    load, shortening, deflection = curve(friction, excess)
    inside = shortening <= limit
    return tuple(np.concatenate([[0.0], values[inside]]) for values in (load, shortening, deflection))


def up_to_shortening_with_small_slopes(friction, limit, count=400):
    """The same curve under the law `beam_column` (src/model.md, 4.8), over u = μ tan λ with λ² = F L²/EI."""
    u = np.linspace(0.0, 2.0 * np.sqrt(limit) + 3.0 * friction, count + 1)[1:]  # its δ/L is at least `limit`
    root = np.arctan2(u, friction)  # λ
    shortening = 0.75 * friction**2 + 0.25 * u**2 - 0.75 * friction * u / root
    inside = shortening <= limit
    return tuple(np.concatenate([[0.0], values[inside]]) for values in (root**2, shortening, u / root - friction))


def angles_from_tip(tips, lengths):
    """Angles ψ between blade and force, a row for each at the tip (below π) and a column for each length from there.

    Lengths are in units of √(EI/force), the force being F/cos β: a blade ends at the hub where ψ = β, at the length q.
    """
    alpha = np.linspace(0.0, np.pi, 4001)
    rows = []
    for kappa in np.sin(0.5 * np.asarray(tips)):
        sine = kappa * np.cos(alpha)
        stretch = 1.0 / np.sqrt(1.0 - sine**2)
        length = np.concatenate([[0.0], np.cumsum(0.5 * (stretch[1:] + stretch[:-1]) * np.diff(alpha))])
        rows.append(np.interp(lengths, length, 2.0 * np.arcsin(sine)))
    return np.array(rows)

/// The elastica under a tip load of any inclination, in double precision: every equilibrium of the
/// cantilever, bent to either side, with its derivatives.
///
/// The tip carries a load of magnitude P at the signed load angle b against the blade's axis: −P (cos b, sin
/// b) along and across the undeformed blade. Seen from the tip, the slope against the load line, ψ(w) with w
/// = q (1 − σ/L) and q² = P L²/EI, swings like a pendulum let go at rest (Kirchhoff's analogy): ψ'' = −sin ψ,
/// ψ(0) = A. Hence the chart of all equilibria (MODEL 3.2; Love, Mathematical Theory of Elasticity, article
/// 262):
///     κ = sin(A/2)    modulus, with the sign of the deflection D below,
///     φ               amplitude at the clamp; sin(ψ/2) = κ cos φ', φ' from 0 at the tip to φ,
///     sin(b/2) = κ cos φ,   q = ∫0^φ dφ' / sqrt(1 − κ² cos² φ').
/// φ → 0 is the unloaded blade (q ≈ φ), φ = π/2 the column (b = 0), φ > π/2 a blade bent against the side
/// component of its load. The functions are analytic and single-valued all over the chart, through b = 0 too,
/// where the functions of MODEL 3.2 change branch. The integrals are taken as in `elastica.cpp`, so that
/// nothing cancels for a light load.
#pragma once

namespace rubatlas::blade {

/// A value and its derivatives by κ and by φ.
struct Inclined {
  double value;
  double by_modulus;
  double by_amplitude;
};

struct InclinedPoint {
  Inclined load;        ///< P L² / EI = q² [-], never negative
  double curvature;     ///< θ'(0) L [-] at the clamp, signed as κ
  Inclined load_angle;  ///< b [rad]
  Inclined shortening;  ///< δ / L [-]
  Inclined deflection;  ///< D / L [-], signed: towards the side to which a load with b > 0 pushes
};

/// A bent blade, as a point of the chart.
struct Bend {
  double modulus;    ///< κ [-]
  double amplitude;  ///< φ [rad]
};

/// Largest modulus |κ| and amplitude φ for which the quadrature keeps its accuracy; they include shortenings
/// of more than 0.8 L.
inline constexpr double kLargestModulus = 0.999;
inline constexpr double kLargestAmplitude = 3.14;

/// Equilibrium at −kLargestModulus <= κ <= kLargestModulus, 0 <= φ <= kLargestAmplitude; φ = 0: without load.
/// It is even in φ. Relative errors of a few 1e-15 against `equilibrium`, however small the load.
InclinedPoint inclined_equilibrium(Bend bend);

}  // namespace rubatlas::blade

/// The blade as an elastica: exact tip shortening and deflection under a dead load (MODEL 3.1, 3.2).
///
/// An inextensible cantilever of length L and bending stiffness EI carries at its tip a compressive axial
/// load F and a lateral load μF, both of fixed direction. With β = atan μ and the tip angle θL = ψL − β, the
/// curve of all equilibria is followed by the bending parameter
///     u = sqrt(ψL² − β²),   so that  θL = u² / (ψL + β)
/// because force, shortening and deflection are analytic and even (μ > 0) in u right through the unloaded
/// blade (F ~ u²) and, for μ = 0, through buckling (F → Euler load, Δ ~ u). κ = sin(ψL/2).
///
/// The Legendre form of MODEL 3.2 is 0/0 at small loads. Here the same integrals are taken over the
/// complementary amplitude α (sin χ = cos α), in which nothing cancels: relative accuracy holds down to u =
/// 1e-150.
#pragma once

namespace rubatlas::blade {

/// One equilibrium of the blade, dimensionless.
template <class Real>
struct Equilibrium {
  Real load;        ///< F L² / EI [-]
  Real shortening;  ///< δ / L [-]
  Real deflection;  ///< Δ / L [-]
};

/// `friction` μ >= 0, bending parameter u >= 0 with ψL < π. Double-precision accurate to a few 1e-16 relative
/// for tip shortenings up to 0.8 L.
Equilibrium<long double> equilibrium(long double friction, long double bending);

}  // namespace rubatlas::blade

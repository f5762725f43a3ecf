/// The rows of tests/reference/elastica.json, and the way back from a load to the bending parameter.
#pragma once

#include <vector>

namespace rubatlas::blade {

struct ReferenceRow {
  double friction;    ///< μ
  double load;        ///< F L²/EI
  double kappa;       ///< κ = sin(ψL/2)
  double shortening;  ///< δ/L
  double deflection;  ///< Δ/L
};

/// The file prints 16 digits, of which the last is rounded.
constexpr double kReferenceAccuracy = 1e-12;

const std::vector<ReferenceRow>& reference_rows();

/// u with `equilibrium(friction, u).load` equal to `load`, by bisection in 80-bit arithmetic: near the Euler
/// load a bit of the load is worth a thousand of the shortening.
long double bending_at_load(double friction, double load);

}  // namespace rubatlas::blade

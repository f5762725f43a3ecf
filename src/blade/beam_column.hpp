/// The blade as a beam-column: tip shortening and deflection under a dead load, for small slopes.
///
/// An inextensible cantilever of length L and bending stiffness EI carries at its tip a compressive axial
/// load F and a lateral load μF. With the slope w' small against one,
///     EI w'' = F (Δ − w) + μF (L − x),   w(0) = w'(0) = 0
/// (Timoshenko & Gere, Theory of Elastic Stability, 2nd ed., beam-columns, ch. 1; Euler load of the
/// cantilever, sect. 2.1). With λ = sqrt(F L²/EI) and the bending parameter of the elastica,
///     u = sqrt(ψL² − μ²) = μ tan λ,   ψL = w'(L) + μ = μ / cos λ,
///     Δ/L = u/λ − μ,   δ/L = ½ ∫ w'² dx/L = ¾ μ² + u²/4 − ¾ μ u/λ.
/// The load stays below the Euler load π²/4, and is the Euler load for every u where μ = 0.
#pragma once

#include "blade/elastica.hpp"

namespace rubatlas::blade {

/// `friction` μ >= 0, bending parameter u >= 0, not both zero for a loaded blade. Relative accuracy of a few
/// 1e-19 however small the load: the integrals are taken over w' as a product, in which nothing cancels.
Equilibrium<long double> beam_column_equilibrium(long double friction, long double bending);

}  // namespace rubatlas::blade

/// The first place in a step where a guard passes from negative to positive, however short it stays positive.
///
/// A guard is a smooth function of the fraction θ of a step: a gap, a slip velocity, the distance to a limit.
/// It is negative while a mode lasts, and the mode ends where the guard becomes positive. The signs at the
/// ends of a step do not tell whether this happens: a guard may pass zero twice in between. So the guard is
/// sampled, and the polynomial through the samples bounds it. An interval needs no further search where this
/// bound is below zero, or where the guard rises or falls throughout. Otherwise the interval is halved, also
/// where large last coefficients show that the polynomial does not represent the guard yet.
///
/// Chebyshev coefficients a_k bound a function on [−1, 1] by |T_k| <= 1, and its derivative by |T_k'| <= k²
/// (L. N. Trefethen, Approximation Theory and Approximation Practice, SIAM 2013, chapters 3 and 4).
#pragma once

#include <optional>

#include "integrate/function_view.hpp"

namespace rubatlas::integrate {

/// First argument in [low, high] where `guard` passes from negative to positive, or none; `low` where it is
/// positive there already. `at_low`, `at_high`: its values at the ends, where it is not evaluated. Positive
/// values up to `rounding` count as zero between the ends. Where the guard is not a number it does not cross.
std::optional<double> first_crossing(FunctionView guard, double low, double high, double at_low,
                                     double at_high, double rounding = 0.0);

/// First argument in (low, high] where `function` changes its sign, whichever sign it starts with; the
/// function is not evaluated at `low`. To find the next root of a function f that is zero at `low`, pass
/// f(x)/(x − low), which has no root there.
std::optional<double> first_sign_change(FunctionView function, double low, double high, double at_high);

/// First maximum of a function between `low` and `high`, or none, from its slope; `at_low`, `at_high`: the
/// slope at the ends.
std::optional<double> first_top(FunctionView slope, double low, double high, double at_low, double at_high);

}  // namespace rubatlas::integrate

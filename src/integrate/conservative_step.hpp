/// How far a smooth function that is not positive can be followed before it could possibly become positive.
///
/// Conservative advancement: with value, slope and curvature at a point and a bound on the third derivative,
/// the cubic majorant q(t) = g + g' t + g'' t²/2 + M t³/6 bounds the function from above. Up to the first
/// positive root of q there is no touch-down, however grazing. Steps shrink superlinearly towards a true
/// root, so that repeated steps also locate the root, from below.
#pragma once

namespace rubatlas::integrate {

/// Lower bound, tight to about 1e-12 relative, of the first t > 0 at which q could be positive.
/// `value` <= 0; `third_bound` M > 0. Returns 0 when value is 0 and the slope positive.
double conservative_step(double value, double slope, double curvature, double third_bound);

}  // namespace rubatlas::integrate

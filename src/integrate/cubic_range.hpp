/// Bounds of a function within a step, estimated from its values and slopes at the ends.
#pragma once

#include <algorithm>
#include <cmath>

namespace rubatlas::integrate {

struct Range {
  double least;
  double greatest;
};

/// From values and slopes by the fraction θ at both ends. The Bézier points of the cubic through these
/// enclose the cubic. They are widened by a tenth of their second differences, since the function is not a
/// cubic; sinusoids of up to three radians in a step would not need this.
inline Range cubic_range(double at_begin, double slope_at_begin, double at_end, double slope_at_end) {
  const double second = at_begin + slope_at_begin / 3.0;
  const double third = at_end - slope_at_end / 3.0;
  const double margin =
      0.1 * (std::abs(third - 2.0 * second + at_begin) + std::abs(at_end - 2.0 * third + second));
  return {std::min(std::min(at_begin, at_end), std::min(second, third)) - margin,
          std::max(std::max(at_begin, at_end), std::max(second, third)) + margin};
}

/// The same of (f(θ) − f(0))/θ, from slopes and increment of f: the three Bézier points of a parabola,
/// widened by a sixth of the sum of their two differences.
inline Range cubic_range_of_mean_slope(double slope_at_begin, double increment, double slope_at_end) {
  const double second = 1.5 * increment - 0.5 * slope_at_end;
  const double margin = (std::abs(second - slope_at_begin) + std::abs(increment - second)) / 6.0;
  return {std::min(slope_at_begin, std::min(second, increment)) - margin,
          std::max(slope_at_begin, std::max(second, increment)) + margin};
}

/// Whether the function may rise and fall again within the step: whether the slope of the cubic may come from
/// above zero to below, as its three Bézier points have it. `rounding`: slopes within it are zero.
inline bool cubic_may_peak(double slope_at_begin, double increment, double slope_at_end,
                           double rounding = 0.0) {
  const double between = 3.0 * increment - slope_at_begin - slope_at_end;
  return (slope_at_begin > rounding && (between < -rounding || slope_at_end < -rounding)) ||
         (between > rounding && slope_at_end < -rounding);
}

}  // namespace rubatlas::integrate

/// Between which values a function stays in a step, as far as its ends tell.
#pragma once

#include <algorithm>

namespace rubatlas::integrate {

struct Range {
  double least;
  double greatest;
};

/// From values and slopes by the fraction at both ends: the Bézier points of the cubic that these give
/// enclose it. They are widened by half of their spread for what the cubic leaves out: of a sinusoid over θ
/// in a step of φ radians that is at most φ⁴/384 of its amplitude, 0.1 at φ = 2.5, where the spread is 1.5
/// and more.
inline Range cubic_range(double at_begin, double slope_at_begin, double at_end, double slope_at_end) {
  const double second = at_begin + slope_at_begin * (1.0 / 3.0);
  const double third = at_end - slope_at_end * (1.0 / 3.0);
  const double least = std::min(std::min(at_begin, at_end), std::min(second, third));
  const double greatest = std::max(std::max(at_begin, at_end), std::max(second, third));
  const double margin = 0.5 * (greatest - least);
  return {least - margin, greatest + margin};
}

}  // namespace rubatlas::integrate

/// From an error estimate to acceptance and the size of the next step (Hairer, Nørsett, Wanner I, II.4 and
/// II.5).
#pragma once

#include <algorithm>
#include <cmath>

namespace rubatlas::integrate {

/// The combination of the two embedded estimates that DOP853 uses, in units of the tolerance: accepted up
/// to 1.
inline double combined_error(double fifth, double third) {
  const double denominator = std::sqrt(fifth * fifth + 0.01 * third * third);
  return denominator > 0.0 ? fifth * fifth / denominator : 0.0;
}

/// Factor for the next step of a method whose error falls with size^order.
inline double step_factor(double error, int order) {
  constexpr double kSafety = 0.9;
  constexpr double kShrinkMost = 0.2;
  constexpr double kGrowMost = 2.0;
  if (!(error > 0.0)) return kGrowMost;
  return std::clamp(kSafety * std::pow(error, -1.0 / order), kShrinkMost, kGrowMost);
}

}  // namespace rubatlas::integrate

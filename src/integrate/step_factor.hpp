/// The textbook rule for the size of the next step (Hairer, Nørsett, Wanner I, II.4).
#pragma once

#include <algorithm>
#include <cmath>

namespace rubatlas::integrate {

/// Factor for the next step, from an error in units of what is accepted (infinite where the step could not
/// be made at all), for an estimate that falls with size^order.
inline double step_factor(double error, int order) {
  constexpr double kSafety = 0.9;
  constexpr double kShrinkMost = 0.2;
  constexpr double kGrowMost = 5.0;
  if (!(error > 0.0)) return kGrowMost;
  return std::clamp(kSafety * std::pow(error, -1.0 / order), kShrinkMost, kGrowMost);
}

}  // namespace rubatlas::integrate

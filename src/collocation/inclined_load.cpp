#include "collocation/inclined_load.hpp"

#include <cmath>
#include <numbers>

#include "blade/inclined_elastica.hpp"

namespace rubatlas::collocation {

const double InclinedLoad::kEndCosine = std::cos(std::numbers::pi - blade::kLargestAmplitude);
const double InclinedLoad::kEndSine = std::sin(std::numbers::pi - blade::kLargestAmplitude);

double InclinedLoad::argument(double u) const {
  constexpr int kMost = 20;
  constexpr double kLastStep = 1e-15;
  double p = std::asinh(u / scale);
  for (int i = 0; i < kMost; ++i) {
    const double step = (u - bending(p)) / bending_slope(p * p);
    p += step;
    if (std::abs(step) <= kLastStep * std::abs(p)) break;
  }
  return p;
}

}  // namespace rubatlas::collocation

#include "collocation/inclined_load.hpp"

#include <cmath>
#include <numbers>

#include "blade/inclined_elastica.hpp"

namespace rubatlas::collocation {

const InclinedLoad::ChartEnd InclinedLoad::kChartEnd{std::cos(std::numbers::pi - blade::kLargestAmplitude),
                                                     std::sin(std::numbers::pi - blade::kLargestAmplitude)};

// With ψ the angle of the tip's slope against the load, u² = sin²(ψ/2) − sin²(β/2), and the p of the table is
// that of β sinh p = (ψ² − β²)^½ (`blade/elastica.hpp`).

double InclinedLoad::bending_of_table(double p) const {
  const double angle = table->scale();
  const double more = angle * std::sinh(0.5 * p) * std::sinh(0.5 * p);  // (ψ − β)/2
  return std::copysign(std::sqrt(std::sin(angle + more) * std::sin(more)), p);
}

double InclinedLoad::bending_slope_of_table(double p) const {
  const double angle = table->scale();
  const double tip_angle = angle * std::cosh(p);
  const double u = bending_of_table(p);
  if (u == 0.0) return 0.5 * std::sqrt(angle * std::sin(angle));
  return 0.25 * std::sin(tip_angle) * angle * std::sinh(p) / u;
}

double InclinedLoad::argument(double u) const {
  if (table != nullptr) {
    const double angle = table->scale();
    const double sine = std::sin(0.5 * angle);
    const double modulus = std::hypot(u, sine);
    // sin of (ψ − β)/2
    const double more = std::asin(u * u / std::sin(std::asin(modulus) + 0.5 * angle));
    return 2.0 * std::asinh(std::sqrt(more / angle));
  }
  constexpr int kMost = 20;
  constexpr double kLastStep = 1e-15;
  double p = std::asinh(u / scale);
  for (int i = 0; i < kMost; ++i) {
    const double step = (u - bending(p)) / bending_slope(p);
    p += step;
    if (std::abs(step) <= kLastStep * std::abs(p)) break;
  }
  return p;
}

}  // namespace rubatlas::collocation

/// How an error falls with the step.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

namespace rubatlas::integrate {

template <class Vector>
double largest_difference(const Vector& one, const Vector& other) {
  return (one - other).abs().maxCoeff();
}

/// Slope of log(error) over log(size), by least squares.
inline double convergence_order(const std::vector<std::pair<double, double>>& errors) {
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [size, error] : errors) {
    x += std::log(size);
    y += std::log(error);
    xx += std::log(size) * std::log(size);
    xy += std::log(size) * std::log(error);
  }
  const auto n = static_cast<double>(errors.size());
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace rubatlas::integrate

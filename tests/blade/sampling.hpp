/// Which blades and how far bent: the sampling that the tests of the closed form and of its table share.
#pragma once

#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "blade/elastica.hpp"

namespace rubatlas::blade {

/// Coulomb coefficients, from none over barely any to the largest that a scene may have.
inline const std::vector<double>& frictions() {
  static const std::vector<double> kFrictions = {0.0,  1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 0.01,
                                                 0.05, 0.1,   0.2,  0.5,  1.0,  1.5,  2.0};
  return kFrictions;
}

/// Bending parameter at which the tip has come down by `shortening` of L.
inline double bending_at_shortening(double friction, double shortening) {
  const double beta = std::atan(friction);
  const double highest = std::sqrt((std::numbers::pi - beta) * (std::numbers::pi + beta)) * 0.999;
  const auto excess = [&](double bending) {
    return static_cast<double>(equilibrium(friction, bending).shortening) - shortening;
  };
  return boost::math::tools::bisect(excess, 0.0, highest, boost::math::tools::eps_tolerance<double>()).first;
}

/// Bending parameters from next to nothing (1e-12 of β, where the load is 1e-24 of the Euler load) up to the
/// given shortening: even steps in the logarithm and, where the blade is visibly bent, in u.
inline std::vector<double> bendings(double friction, double largest_shortening, int count) {
  const double last = bending_at_shortening(friction, largest_shortening);
  const double first = friction > 0.0 ? 1e-12 * std::atan(friction) : 1e-12;
  std::vector<double> result;
  for (int i = 0; i < count; ++i) {
    const double part = (i + 0.37) / count;
    result.push_back(first * std::pow(last / first, part));
    result.push_back(last * part);
  }
  result.push_back(last);
  return result;
}

}  // namespace rubatlas::blade

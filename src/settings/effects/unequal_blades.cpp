#include "settings/effects/unequal_blades.hpp"

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cstddef>

namespace rubatlas::effects {

bool UnequalBlades::acts() const {
  const auto any = [](const std::vector<double>& errors) {
    return std::ranges::any_of(errors, [](double error) { return error != 0.0; });
  };
  return any(length_errors) || any(thickness_errors) || any(angle_errors) || length_spread > 0.0 ||
         thickness_spread > 0.0 || angle_spread > 0.0;
}

std::vector<BladeError> UnequalBlades::errors(int blade_count) const {
  std::vector<BladeError> result(static_cast<std::size_t>(blade_count));
  boost::random::mt19937_64 generator(static_cast<unsigned>(seed));
  boost::random::normal_distribution<double> normal;
  const auto add = [&](double BladeError::*error, const std::vector<double>& given, double spread) {
    for (std::size_t k = 0; k < result.size(); ++k) {
      const double drawn = normal(generator);
      result[k].*error = (k < given.size() ? given[k] : 0.0) + spread * drawn;
    }
  };
  add(&BladeError::length, length_errors, length_spread);
  add(&BladeError::thickness, thickness_errors, thickness_spread);
  add(&BladeError::angle, angle_errors, angle_spread);
  return result;
}

}  // namespace rubatlas::effects

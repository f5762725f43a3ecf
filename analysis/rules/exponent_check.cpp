#include "analysis/rules/exponent_check.hpp"

#include <cmath>

#include "analysis/rules/class.hpp"

namespace rubatlas::analysis {

ExponentCheck check_exponent(std::uint8_t motion, double largest, double standard_error) {
  constexpr double kFromZero = 2.0;  // standard errors
  const bool periodic = is_periodic(motion);
  if (!(periodic || motion == motion_class::kAperiodic) || !std::isfinite(largest))
    return ExponentCheck::none;
  if (!(std::abs(largest) > kFromZero * standard_error)) return ExponentCheck::undecided;
  return (largest < 0.0) == periodic ? ExponentCheck::agrees : ExponentCheck::disagrees;
}

}  // namespace rubatlas::analysis

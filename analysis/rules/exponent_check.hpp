/// Two ways to tell regular from chaotic motion, held against each other: class and largest exponent.
#pragma once

#include <cstdint>

namespace rubatlas::analysis {

/// Whether the largest Lyapunov exponent agrees with the class of a motion: negative where it is periodic,
/// positive where it is aperiodic. The numbers are those of the flags in MAPS.h5.
enum class ExponentCheck : std::uint8_t {
  none = 0,  ///< no exponent, or no class
  agrees = 1,
  disagrees = 2,
  undecided = 3,  ///< the exponent is zero within two standard errors
};

[[nodiscard]] ExponentCheck check_exponent(std::uint8_t motion, double largest, double standard_error);

}  // namespace rubatlas::analysis

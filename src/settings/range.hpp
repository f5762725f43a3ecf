/// The legal values of a number, which every description of a quantity needs. This file includes no other
/// file of the project, so that an effect can describe its quantities in its own file.
#pragma once

#include <limits>
#include <string>

namespace rubatlas::settings {

/// Legal values of a number; a bound may be excluded, and infinite bounds are written as such.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_excluded = false;
  bool high_excluded = false;

  [[nodiscard]] bool contains(double value) const;
  /// In interval notation: "[0, 2]", "(0, inf)".
  [[nodiscard]] std::string text() const;
};

constexpr Range above_zero_up_to(double high) {
  return {.low = 0.0, .high = high, .low_excluded = true};
}
constexpr Range between(double low, double high) {
  return {.low = low, .high = high};
}

// Upper bounds without a physical reason are there to catch a slip of units before it costs a night of
// computing.
constexpr double kLongestLength = 1e3;  ///< [m]
constexpr double kHeaviestMass = 1e9;   ///< [kg]

}  // namespace rubatlas::settings

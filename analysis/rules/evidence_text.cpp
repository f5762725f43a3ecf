#include "analysis/rules/evidence_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rubatlas::analysis {

std::string speed_text(const Interval& between) {
  constexpr int kMostDigits = 15;
  constexpr double kNoise = 1e-6;  // of the numbers themselves, in units of the last digit
  const double half = 0.5 * (between.upper - between.lower);
  if (!(half > 0.0)) return fmt::format("{}", between.lower);
  const int digits = std::clamp(static_cast<int>(-std::floor(std::log10(half))), 0, kMostDigits);
  const double unit = std::pow(10.0, digits);
  const double middle = 0.5 * (between.upper + between.lower);
  // Rounding moves the middle: the uncertainty covers both ends all the same.
  const double rounded = std::abs(std::round(middle * unit) - middle * unit);
  return fmt::format("{:.{}f}({:.0f})", middle, digits, std::ceil(half * unit + rounded - kNoise));
}

std::string extent_text(const Region& region) {
  const auto end = [](double speed, bool is_open, const Interval& between) {
    if (between.is_known()) return speed_text(between);
    return is_open ? fmt::format("({:.3f})", speed) : fmt::format("{:.3f}", speed);
  };
  return fmt::format("{}-{}", end(region.from, region.begins_open, region.from_between),
                     end(region.to, region.ends_open, region.to_between));
}

}  // namespace rubatlas::analysis

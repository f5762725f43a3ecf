#include "analysis/rules/evidence_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/rules/parameter.hpp"

namespace rubatlas::analysis {
namespace {

std::string_view absence_text(Presence presence) {
  switch (presence) {
    case Presence::absent:
      return "absent";
    case Presence::merged:
      return "merged with region 2";
    default:
      return "not covered";
  }
}

}  // namespace

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
  const auto end = [](double speed, bool at_gap, const Interval& between) {
    if (between.is_known()) return speed_text(between);
    return at_gap ? fmt::format("({:.3f})", speed) : fmt::format("{:.3f}", speed);
  };
  return fmt::format("{}-{}", end(region.from, region.begins_at_gap, region.from_between),
                     end(region.to, region.ends_at_gap, region.to_between));
}

std::string region_text(int number, const Region& region) {
  if (!region.present()) return fmt::format("region {}: {}", number, absence_text(region.presence));
  return fmt::format("region {}: {}, {:.0f} % aperiodic, peak {}", number, extent_text(region),
                     100.0 * region.aperiodic_share, millimetres(region.peak_displacement));
}

std::string trigger_text(int number, const Trigger& trigger) {
  if (trigger.presence != Presence::present) {
    return fmt::format("trigger {}: {}", number, absence_text(trigger.presence));
  }
  return fmt::format("trigger {}: at {:.3f}, {} to {} (×{:.3g})", number, trigger.speed_ratio,
                     millimetres(trigger.displacement_below), millimetres(trigger.displacement_above),
                     trigger.ratio());
}

}  // namespace rubatlas::analysis

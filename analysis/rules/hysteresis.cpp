#include "analysis/rules/hysteresis.hpp"

#include <algorithm>

#include "analysis/rules/attractors.hpp"

namespace rubatlas::analysis {
namespace {

void add_once(std::vector<std::uint8_t>& sorted, std::uint8_t value) {
  const auto place = std::ranges::lower_bound(sorted, value);
  if (place == sorted.end() || *place != value) sorted.insert(place, value);
}

}  // namespace

bool HysteresisRange::is_aperiodic() const {
  const std::vector<std::uint8_t> aperiodic{motion_class::kAperiodic};
  return up == aperiodic && down == aperiodic;
}

Hysteresis find_hysteresis(std::span<const double> speed_ratio, std::span<const std::uint8_t> motion,
                           std::span<const std::int32_t> attractor,
                           std::span<const double> max_displacement) {
  Hysteresis found;
  const std::size_t speeds = speed_ratio.size();
  const std::size_t of_one_direction = motion.size() / 2;
  bool within = false;
  for (std::size_t up = 0; up < of_one_direction; ++up) {
    const std::size_t down = up + of_one_direction;
    if (up % speeds == 0) within = false;
    if (attractor[up] == 0 || attractor[down] == 0) continue;
    const bool differ = attractor[up] != attractor[down];
    const bool aperiodic = motion[up] == motion_class::kAperiodic && motion[down] == motion_class::kAperiodic;
    ++found.compared;
    if (aperiodic) ++found.compared_aperiodic;
    if (differ && !within) found.ranges.push_back({.line = up / speeds, .from = speed_ratio[up % speeds]});
    within = differ;
    if (!differ) continue;
    ++found.different;
    if (aperiodic) ++found.different_aperiodic;
    auto& range = found.ranges.back();
    range.to = speed_ratio[up % speeds];
    ++range.speeds;
    range.may_be_shifted = range.may_be_shifted && may_be_shifted(motion[up], max_displacement[up],
                                                                  motion[down], max_displacement[down]);
    add_once(range.up, motion[up]);
    add_once(range.down, motion[down]);
  }
  return found;
}

}  // namespace rubatlas::analysis

#include "analysis/rules/attractors.hpp"

#include <algorithm>
#include <cmath>

namespace rubatlas::analysis {

bool may_be_shifted(std::uint8_t motion, double displacement, std::uint8_t other_motion,
                    double other_displacement) {
  const double tolerance = kMatchingFactor * ClosingTolerance{}.relative;
  return is_periodic(motion) && motion == other_motion &&
         std::abs(displacement - other_displacement) <=
             tolerance * std::max(displacement, other_displacement);
}

Attractors::Attractors(const ClosingTolerance& closing)
    : matching_{.relative = kMatchingFactor * closing.relative, .floor = kMatchingFactor * closing.floor} {}

std::size_t Attractors::first_of(std::size_t motion) {
  while (earlier_[motion] != motion) {
    earlier_[motion] = earlier_[earlier_[motion]];  // keeps the way to the first one short
    motion = earlier_[motion];
  }
  return motion;
}

void Attractors::add(const MotionTrace& motion, std::span<const double> sections) {
  const std::size_t own = earlier_.size();
  earlier_.push_back(own);
  const bool periodic = is_periodic(motion.motion);
  has_attractor_.push_back(periodic || motion.motion == motion_class::kAperiodic);
  if (!has_attractor_.back()) return;
  for (const Known& known : known_) {
    const std::size_t mine = first_of(own);
    const std::size_t other = first_of(known.motion);
    if (mine == other || !is_same_motion(motion, sections, known.trace, matching_)) continue;
    earlier_[std::max(mine, other)] = std::min(mine, other);
  }
  // All motions on a periodic attractor are alike, while each aperiodic one may be a link of a chain.
  if (!periodic || first_of(own) == own) known_.push_back({own, motion});
}

std::vector<std::int32_t> Attractors::numbers() const {
  std::vector<std::int32_t> numbers(earlier_.size(), 0);
  std::int32_t count = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!has_attractor_[i]) continue;
    numbers[i] = earlier_[i] == i ? ++count : numbers[earlier_[i]];
  }
  return numbers;
}

}  // namespace rubatlas::analysis

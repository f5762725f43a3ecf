#include "analysis/rules/gaps.hpp"

#include <cmath>

namespace rubatlas::analysis {
namespace {

bool gap_beside(const Line& line, SpeedScale scale, std::size_t point, std::ptrdiff_t step) {
  auto last = static_cast<std::ptrdiff_t>(point);
  const auto inside = [&](std::ptrdiff_t i) { return i >= 0 && i < std::ssize(line.speed_ratio); };
  if (!inside(last + step) || is_done(line, static_cast<std::size_t>(last + step))) return false;
  while (inside(last + step)) {
    last += step;
    if (is_done(line, static_cast<std::size_t>(last))) break;
  }
  const double far = line.speed_ratio[static_cast<std::size_t>(last)];
  return scale.scaled(std::abs(far - line.speed_ratio[point])) > kLongestHole;
}

}  // namespace

bool is_done(const Line& line, std::size_t point) {
  return (point < line.motion.size() && line.motion[point] != motion_class::kNone) ||
         (point < line.max_displacement.size() && std::isfinite(line.max_displacement[point]));
}

bool gap_above(const Line& line, SpeedScale scale, std::size_t point) {
  return gap_beside(line, scale, point, +1);
}

bool gap_below(const Line& line, SpeedScale scale, std::size_t point) {
  return gap_beside(line, scale, point, -1);
}

}  // namespace rubatlas::analysis

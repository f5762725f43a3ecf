#include "analysis/rules/class.hpp"

#include <algorithm>
#include <cmath>

namespace rubatlas::analysis {
namespace {

double norm(double x, double y, double vx, double vy) {
  return std::sqrt(x * x + y * y + vx * vx + vy * vy);
}

std::uint8_t class_of_record(std::span<const double> states, double tolerance, std::size_t longest) {
  bool nearly = false;
  for (std::size_t period = 1; period <= longest; ++period) {
    const double distance = closing_distance(states, period);
    if (distance <= tolerance) {
      // A shorter period nearly closes: a period doubling has just begun, or the motion has not settled yet.
      return nearly ? motion_class::kUnresolved : static_cast<std::uint8_t>(period);
    }
    nearly = nearly || distance <= kUnresolvedFactor * tolerance;
  }
  return nearly ? motion_class::kUnresolved : motion_class::kAperiodic;
}

}  // namespace

double orbit_size(std::span<const double> states) {
  double size = 0.0;
  for (std::size_t i = 0; i + kStateSize <= states.size(); i += kStateSize) {
    const double length = norm(states[i], states[i + 1], states[i + 2], states[i + 3]);
    if (!(length <= size)) size = length;
    if (std::isnan(size)) return size;
  }
  return size;
}

double closing_distance(std::span<const double> states, std::size_t period) {
  const std::size_t step = kStateSize * period;
  double largest = 0.0;
  for (std::size_t i = 0; i + step + kStateSize <= states.size(); i += kStateSize) {
    const std::size_t j = i + step;
    largest = std::max(largest, norm(states[j] - states[i], states[j + 1] - states[i + 1],
                                     states[j + 2] - states[i + 2], states[j + 3] - states[i + 3]));
  }
  return largest;
}

std::uint8_t classify(std::span<const double> states, const ClosingTolerance& closing) {
  const std::size_t sections = states.size() / kStateSize;
  const double size = orbit_size(states);
  if (sections == 0 || !std::isfinite(size)) return motion_class::kNone;
  const std::size_t half = sections / 2;
  if (half < 2) return motion_class::kUnresolved;

  const std::size_t longest = std::min<std::size_t>(motion_class::kLongestPeriod, half - 1);
  // One tolerance for the whole and the halves: a half is not to close merely because it is smaller.
  const double tolerance = std::max(closing.relative * size, closing.floor);
  const std::uint8_t whole = class_of_record(states, tolerance, longest);
  const std::uint8_t first = class_of_record(states.first(half * kStateSize), tolerance, longest);
  const std::uint8_t second = class_of_record(states.subspan(half * kStateSize), tolerance, longest);
  if (whole != first || whole != second) return motion_class::kUnresolved;
  // A record that is too short cannot exclude long periods.
  if (whole == motion_class::kAperiodic && longest < motion_class::kLongestPeriod) {
    return motion_class::kUnresolved;
  }
  return whole;
}

}  // namespace rubatlas::analysis

#include "analysis/rules/signature.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "analysis/rules/median.hpp"
#include "analysis/rules/triggers.hpp"

namespace rubatlas::analysis {
namespace {

/// Half width of a line [orders]; an order at its very end counts as within.
double half_width(std::span<const double> orders) {
  return std::max(kLineHalfWidth, kLineBins * orders[1]) * (1.0 + 1e-9);
}

/// One height along a line: the logarithm, and the level over stretches of it.
class Course {
 public:
  Course(std::span<const double> speed_ratio, std::span<const double> heights, double floor,
         SpeedScale scale) {
    for (std::size_t i = 0; i < speed_ratio.size(); ++i) {
      scaled_.push_back(scale.scaled(speed_ratio[i]));
      const double height = heights[i];
      log_.push_back(std::isfinite(height) ? std::log(std::max(height, floor)) : kNotANumber);
    }
  }

  [[nodiscard]] bool is_known(std::size_t point) const { return !std::isnan(log_[point]); }

  /// Mean over the points up to a stretch below `point`, or over those of the stretch below that one; NaN
  /// where there are fewer than two.
  [[nodiscard]] double level(std::size_t point, bool the_one_below = false) const {
    const double top = scaled_[point] - (the_one_below ? kTriggerStretch : 0.0);
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = point + 1; i-- > 0 && scaled_[i] > top - kTriggerStretch;) {
      if (scaled_[i] > top || !is_known(i)) continue;
      sum += log_[i];
      ++count;
    }
    return count < 2 ? kNotANumber : sum / count;
  }

 private:
  std::vector<double> scaled_;  ///< Ω n/3 [-]
  std::vector<double> log_;     ///< NaN where not known
};

/// What a sign that stands at the end of the points tells.
enum class Ending : std::uint8_t { limit_is_passed, limit_is_kept, not_covered };

/// Signs among the points below `end`, each held against the level from which it was raised.
Announcement announcement(std::span<const double> speed_ratio, const Course& course, std::size_t end,
                          Ending ending) {
  Announcement found;
  double undisturbed = kNotANumber;  // below the sign that stands
  for (std::size_t i = 0; i < end; ++i) {
    const double level = course.level(i);
    if (!course.is_known(i) || std::isnan(level)) continue;
    if (!std::isnan(undisturbed)) {
      if (level - undisturbed >= std::log(kSignRise)) continue;
      undisturbed = kNotANumber;
      ++found.false_signs;
      continue;
    }
    const double below = course.level(i, true);
    if (std::isnan(below)) continue;
    found.is_judged = true;
    if (level - below >= std::log(kSignRise)) {
      undisturbed = below;
      found.speed_ratio = speed_ratio[i];
    }
  }
  const bool stands = !std::isnan(undisturbed);
  if (stands && ending == Ending::limit_is_passed) return found;
  if (stands && ending == Ending::limit_is_kept) ++found.false_signs;
  found.speed_ratio = kNotANumber;
  return found;
}

}  // namespace

bool shows_signs(std::span<const double> orders, int blades) {
  return orders.size() > 1 && orders[1] <= kCoarsestOrders && orders.back() >= 2.0 * blades;
}

SignHeights sign_heights(std::span<const double> orders, std::span<const double> amplitudes, int blades) {
  const double half = half_width(orders);
  double passing = 0.0;
  double largest = 0.0;
  std::vector<double> power;
  for (std::size_t i = 0; i < orders.size() && orders[i] <= 2.0 * blades + half; ++i) {
    if (!std::isfinite(amplitudes[i])) return {kNotANumber, kNotANumber, kNotANumber};
    if (std::abs(orders[i] - blades) <= half) passing = std::max(passing, amplitudes[i]);
    if (std::abs(orders[i] - std::rint(orders[i])) <= half) continue;
    largest = std::max(largest, amplitudes[i]);
    power.push_back(amplitudes[i] * amplitudes[i]);
  }
  const auto bins = static_cast<double>(power.size());
  return {passing, std::sqrt(bins * median(std::move(power)) / std::numbers::ln2), largest};
}

double LineSignature::announced() const {
  double earliest = kNotANumber;
  for (const auto& sign : signs) earliest = std::fmin(earliest, sign.speed_ratio);
  return earliest;
}

LineSignature find_signs(const SignLine& line, double limit, SpeedScale scale) {
  LineSignature found{.limit = limit};
  const auto beyond = std::ranges::find_if(line.displacement, [&](double one) { return one > limit; });
  const bool passes = beyond != line.displacement.end();
  const auto end = static_cast<std::size_t>(beyond - line.displacement.begin());
  if (passes) found.limit_speed_ratio = line.speed_ratio[end];
  found.passing_is_seen = passes && end > 0 && line.displacement[end - 1] <= limit;
  found.is_kept = std::ranges::all_of(line.displacement, [&](double one) { return one <= limit; });
  const Ending ending = found.passing_is_seen ? Ending::limit_is_passed
                        : found.is_kept       ? Ending::limit_is_kept
                                              : Ending::not_covered;
  const auto announced_by = [&](std::span<const double> heights) {
    const Course course(line.speed_ratio, heights, kSeenShareOfLimit * limit, scale);
    return announcement(line.speed_ratio, course, end, ending);
  };
  for (std::size_t sign = 0; sign < kSignNames.size(); ++sign) {
    std::vector<double> heights;
    for (const auto& at_point : line.heights) heights.push_back(at_point[sign]);
    found.signs[sign] = announced_by(heights);
  }
  found.displacement = announced_by(line.displacement);
  return found;
}

}  // namespace rubatlas::analysis

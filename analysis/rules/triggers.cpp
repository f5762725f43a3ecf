#include "analysis/rules/triggers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/rules/contact.hpp"
#include "analysis/rules/gaps.hpp"

namespace rubatlas::analysis {
namespace {

struct Sample {
  double scaled_speed;
  double log_displacement;
  bool may_touch;
  std::size_t piece;  ///< increases at every gap of the line
};

std::vector<Sample> samples_of(const Line& line, SpeedScale scale, double floor) {
  std::vector<Sample> samples;
  std::size_t piece = 0;
  for (std::size_t i = 0; i < line.size() && i < line.max_displacement.size(); ++i) {
    if (i > 0 && is_done(line, i - 1) && gap_above(line, scale, i - 1)) ++piece;
    const double displacement = line.max_displacement[i];
    if (!std::isfinite(displacement)) continue;
    samples.push_back({scale.scaled(line.speed_ratio[i]), std::log(std::max(displacement, floor)),
                       may_touch(line, i), piece});
  }
  return samples;
}

/// Smallest number of points for a mean, on any grid.
constexpr std::size_t kFewestBesidePeak = 2;
/// Points further away than this many stretches do not count, even on a coarse grid.
constexpr double kFurthest = 3.0;
/// Speeds that are further apart have no two points so near on each side.
constexpr double kWidest = kFurthest * kTriggerStretch / 1.5;

/// Mean of the logarithm over the points within a stretch of `speed`, walking from `first` by `step` and
/// never across a gap.
std::optional<double> level(const std::vector<Sample>& samples, double speed, std::ptrdiff_t first,
                            std::ptrdiff_t step) {
  double sum = 0.0;
  std::size_t count = 0;
  for (auto i = first; i >= 0 && i < std::ssize(samples); i += step) {
    const Sample& sample = samples[static_cast<std::size_t>(i)];
    const double distance = std::abs(sample.scaled_speed - speed) / kTriggerStretch;
    if (sample.piece != samples[static_cast<std::size_t>(first)].piece) break;
    if (distance > kFurthest || (distance > 1.0 && count >= kFewestBesidePeak)) break;
    sum += sample.log_displacement;
    ++count;
  }
  if (count < kFewestBesidePeak) return std::nullopt;
  return sum / static_cast<double>(count);
}

Trigger find_trigger(const std::vector<Sample>& samples, SpeedScale scale, double nominal) {
  Trigger best;
  double largest = 0.0;
  // The trigger is absent only when the whole range was searched, from end to end and without a gap.
  bool searched = !samples.empty() && samples.front().scaled_speed < nominal - kTriggerSearch &&
                  samples.back().scaled_speed > nominal + kTriggerSearch;
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    const double speed = 0.5 * (samples[i].scaled_speed + samples[i + 1].scaled_speed);
    const bool is_gap = samples[i].piece != samples[i + 1].piece;
    const bool in_range = samples[i + 1].scaled_speed > nominal - kTriggerSearch &&
                          samples[i].scaled_speed < nominal + kTriggerSearch;
    const bool is_wide = samples[i + 1].scaled_speed - samples[i].scaled_speed > kWidest;
    if ((is_gap || is_wide) && in_range) searched = false;
    if (is_gap || !samples[i + 1].may_touch || std::abs(speed - nominal) > kTriggerSearch) continue;
    const auto below = level(samples, speed, static_cast<std::ptrdiff_t>(i), -1);
    const auto above = level(samples, speed, static_cast<std::ptrdiff_t>(i) + 1, +1);
    if (!below || !above) {
      searched = false;
      continue;
    }
    if (*above - *below > largest) {
      largest = *above - *below;
      best = {Presence::present, scale.speed_ratio(speed), std::exp(*below), std::exp(*above)};
    }
  }
  if (largest >= std::log(kTriggerRise)) return best;
  return {.presence = searched ? Presence::absent : Presence::not_covered};
}

}  // namespace

std::array<Trigger, 2> find_triggers(const Line& line, SpeedScale scale, double floor) {
  const auto samples = samples_of(line, scale, floor);
  return {find_trigger(samples, scale, kNominalTrigger[0]), find_trigger(samples, scale, kNominalTrigger[1])};
}

}  // namespace rubatlas::analysis

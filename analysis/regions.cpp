#include "analysis/regions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "analysis/stretches.hpp"

namespace rubatlas::analysis {
namespace {

using Points = std::span<const ClassifiedPoint>;

double median(std::vector<double> values) {
  if (values.empty()) return kNotANumber;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// The region over points [first, last]; the displacement is of every finished point between them, the
/// unresolved ones included.
Region region_over(const Line& line, Points points, std::size_t first, std::size_t last) {
  Region region;
  region.presence = Presence::present;
  region.from = line.speed_ratio[points[first].index];
  region.to = line.speed_ratio[points[last].index];
  const auto inside = points.subspan(first, last - first + 1);
  const auto aperiodic = std::ranges::count_if(inside, [](const ClassifiedPoint& p) { return p.aperiodic; });
  region.aperiodic_share = static_cast<double>(aperiodic) / static_cast<double>(inside.size());
  std::vector<double> displacements;
  for (std::size_t i = points[first].index; i <= points[last].index && i < line.max_displacement.size();
       ++i) {
    if (std::isfinite(line.max_displacement[i])) displacements.push_back(line.max_displacement[i]);
  }
  if (!displacements.empty()) region.peak_displacement = std::ranges::max(displacements);
  region.median_displacement = median(std::move(displacements));
  return region;
}

/// Points with a scaled speed in (above, below).
std::size_t count_between(Points points, double above, double below) {
  return static_cast<std::size_t>(std::ranges::count_if(
      points, [=](const ClassifiedPoint& p) { return p.scaled_speed > above && p.scaled_speed < below; }));
}

/// Fewer points than this are not a stretch that could be judged.
constexpr std::size_t kFewestPoints = 3;

bool covered(Points points, double above, double below) {
  return count_between(points, above, below) >= kFewestPoints;
}

Region region_1(const Line& line, Points points, SpeedScale scale, const Trigger& trigger) {
  if (trigger.presence == Presence::not_covered) return {};
  if (trigger.presence != Presence::present) return {.presence = Presence::absent};
  const double end = scale.scaled(trigger.speed_ratio);
  const auto first_above = std::ranges::find_if(points, [=](const auto& p) { return p.scaled_speed > end; });
  const auto count = static_cast<std::size_t>(first_above - points.begin());
  if (count < kFewestPoints) return {};
  return region_over(line, points, 0, count - 1);
}

/// The longest of the stretches that begin in [above, below), after joining them across periodic windows.
std::optional<Stretch> longest_stretch(Points points, const std::vector<Stretch>& all, double above,
                                       double below) {
  std::vector<Stretch> here;
  std::ranges::copy_if(all, std::back_inserter(here), [&](const Stretch& s) {
    return points[s.first].scaled_speed >= above && points[s.first].scaled_speed < below;
  });
  here = join_across_windows(points, std::move(here));
  if (here.empty()) return std::nullopt;
  return *std::ranges::max_element(here, {}, [&](const Stretch& s) {
    return std::pair{length(points, s), s.last - s.first};
  });
}

}  // namespace

double Region::width() const {
  switch (presence) {
    case Presence::present:
      return to - from;
    case Presence::not_covered:
      return kNotANumber;
    default:
      return 0.0;
  }
}

std::array<Region, 4> find_regions(const Line& line, SpeedScale scale,
                                   const std::array<Trigger, 2>& triggers) {
  const auto all = classified_points(line, scale);
  std::array<Region, 4> regions;
  regions[0] = region_1(line, all, scale, triggers[0]);

  // Chaos below the first trigger belongs to region 1; without a trigger, the search for it ends the same
  // way.
  const double start = triggers[0].presence == Presence::present ? scale.scaled(triggers[0].speed_ratio)
                                                                 : kNominalTrigger[0] - kTriggerSearch;
  const auto first_above = std::ranges::find_if(all, [=](const auto& p) { return p.scaled_speed > start; });
  const auto points = Points(all).subspan(static_cast<std::size_t>(first_above - all.begin()));

  const bool covered_2 = covered(points, kNominalTrigger[0], kBetweenTriggers);
  const bool covered_3 = covered(points, kBetweenTriggers, kNominalTrigger[1]);
  const bool covered_4 =
      covered(points, kNominalTrigger[1], 1e9) && covered(points, kNominalTrigger[1] + kTriggerSearch, 1e9);

  const auto stretches = chaotic_stretches(points, kShareWindow, kChaoticShare);
  const auto second = longest_stretch(points, stretches, start, kBetweenTriggers);
  const auto fourth = longest_stretch(points, stretches, kBetweenTriggers, 1e9);

  if (second && covered_2) {
    regions[1] = region_over(line, points, second->first, second->last);
  } else if (covered_2) {
    regions[1].presence = Presence::absent;
  }

  const bool goes_on = second && points[second->last].scaled_speed >= kNominalTrigger[1];
  if (fourth) {
    regions[3] = region_over(line, points, fourth->first, fourth->last);
  } else if (goes_on) {
    regions[3].presence = Presence::merged;
  } else if (covered_4) {
    regions[3].presence = Presence::absent;
  }

  if (!covered_3) return regions;
  const std::size_t from = second ? second->last + 1 : 0;
  const std::size_t to = fourth ? fourth->first : points.size();
  const bool something_between = from < to && regions[3].presence != Presence::merged;
  regions[2] = something_between ? region_over(line, points, from, to - 1) : Region{};
  if (!something_between || regions[2].aperiodic_share >= kChaoticShare) {
    regions[2] = {.presence = Presence::absent};
  }
  return regions;
}

}  // namespace rubatlas::analysis

#include "analysis/rules/regions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "analysis/rules/contact.hpp"
#include "analysis/rules/gaps.hpp"
#include "analysis/rules/median.hpp"
#include "analysis/rules/stretches.hpp"

namespace rubatlas::analysis {
namespace {

using Points = std::span<const ClassifiedPoint>;

bool has_class(std::uint8_t motion) {
  return motion != motion_class::kNone && motion != motion_class::kUnresolved;
}

/// The region over points [first, last], from the first to the last of them that touches; the displacement is
/// of every finished point between them, the unresolved ones included.
Region region_over(const Line& line, SpeedScale scale, Points points, std::size_t first, std::size_t last) {
  while (first <= last && !may_touch(line, points[first].index)) ++first;
  if (first > last) return {.presence = Presence::absent};
  while (!may_touch(line, points[last].index)) --last;
  Region region;
  region.presence = Presence::present;
  region.from = line.speed_ratio[points[first].index];
  region.to = line.speed_ratio[points[last].index];
  const std::span motion(line.motion);
  region.begins_open = gap_below(line, scale, points[first].index) ||
                       std::ranges::none_of(motion.first(points[first].index), has_class);
  region.ends_open = gap_above(line, scale, points[last].index) ||
                     std::ranges::none_of(motion.subspan(points[last].index + 1), has_class);
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

/// A stretch with fewer points cannot be judged.
constexpr std::size_t kFewestPoints = 3;

std::size_t count_between(Points points, double above, double below) {
  return static_cast<std::size_t>(std::ranges::count_if(
      points, [=](const ClassifiedPoint& p) { return p.scaled_speed > above && p.scaled_speed < below; }));
}

/// True when there are enough points with a scaled speed in (above, below), and the line has no gap from the
/// last point before them on to the first one behind them.
bool covered(Points points, double above, double below) {
  std::size_t count = 0;
  const ClassifiedPoint* before = nullptr;
  for (const auto& point : points) {
    if (point.scaled_speed > above) {
      if (before == nullptr || point.piece != before->piece) return false;
      if (point.scaled_speed >= below) return count >= kFewestPoints;
      ++count;
    }
    before = &point;
  }
  return false;
}

Region region_1(const Line& line, Points points, SpeedScale scale, const Trigger& trigger) {
  if (trigger.presence == Presence::not_covered) return {};
  if (trigger.presence != Presence::present) return {.presence = Presence::absent};
  const double end = scale.scaled(trigger.speed_ratio);
  const auto first_above = std::ranges::find_if(points, [=](const auto& p) { return p.scaled_speed > end; });
  const auto count = static_cast<std::size_t>(first_above - points.begin());
  if (count < kFewestPoints) return {};
  std::size_t first = count - 1;
  while (first > 0 && points[first - 1].piece == points[count - 1].piece) --first;
  return region_over(line, scale, points, first, count - 1);
}

/// The periodic stretch, between aperiodic stretches and on one side of a gap, that covers most of (1/2,
/// 2/3).
std::optional<Stretch> periodic_between_triggers(Points points, const std::vector<Stretch>& aperiodic) {
  std::vector<bool> inside(points.size(), false);
  for (const auto& stretch : aperiodic) {
    for (std::size_t i = stretch.first; i <= stretch.last; ++i) inside[i] = true;
  }
  std::optional<Stretch> best;
  double most = 0.0;
  for (std::size_t first = 0; first < points.size(); ++first) {
    if (inside[first]) continue;
    std::size_t last = first;
    const auto goes_on = [&](std::size_t i) { return !inside[i] && points[i].piece == points[first].piece; };
    while (last + 1 < points.size() && goes_on(last + 1)) ++last;
    const double covers = std::min(points[last].scaled_speed, kNominalTrigger[1]) -
                          std::max(points[first].scaled_speed, kBetweenTriggers);
    if (covers >= most) {
      most = covers;
      best = Stretch{first, last};
    }
    first = last;
  }
  return best;
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
      return begins_open || ends_open ? kNotANumber : to - from;
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

  // Aperiodic motion below the first trigger belongs to region 1; without a trigger, the search for it ends
  // the same way.
  const double start = triggers[0].presence == Presence::present ? scale.scaled(triggers[0].speed_ratio)
                                                                 : kNominalTrigger[0] - kTriggerSearch;
  const auto first_above = std::ranges::find_if(all, [=](const auto& p) { return p.scaled_speed > start; });
  const auto points = Points(all).subspan(static_cast<std::size_t>(first_above - all.begin()));

  const bool covered_2 = covered(all, kNominalTrigger[0], kBetweenTriggers);
  const bool covered_3 = covered(all, kBetweenTriggers, kNominalTrigger[1]);
  const double beyond = kNominalTrigger[1] + kTriggerSearch;
  const bool covered_4 = covered(all, kNominalTrigger[1], beyond);

  const auto stretches = aperiodic_stretches(points, kShareWindow, kAperiodicMajority);
  const auto third = periodic_between_triggers(points, stretches);
  const double border =
      third ? 0.5 * (points[third->first].scaled_speed + points[third->last].scaled_speed) : kBetweenTriggers;
  const auto second = longest_stretch(points, stretches, start, border);
  const auto fourth = longest_stretch(points, stretches, border, 1e9);

  if (second) {
    regions[1] = region_over(line, scale, points, second->first, second->last);
  } else if (covered_2) {
    regions[1].presence = Presence::absent;
  }

  const bool goes_on =
      regions[1].presence == Presence::present && points[second->last].scaled_speed >= kNominalTrigger[1];
  if (fourth) {
    regions[3] = region_over(line, scale, points, fourth->first, fourth->last);
  } else if (goes_on) {
    regions[3].presence = Presence::merged;
  } else if (covered_4) {
    regions[3].presence = Presence::absent;
  }

  if (third && count_between(points, kBetweenTriggers, kNominalTrigger[1]) >= kFewestPoints) {
    regions[2] = region_over(line, scale, points, third->first, third->last);
  } else if (covered_3) {
    regions[2].presence = Presence::absent;
  }
  return regions;
}

}  // namespace rubatlas::analysis

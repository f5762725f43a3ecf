#include "analysis/regions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "analysis/gaps.hpp"
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
Region region_over(const Line& line, SpeedScale scale, Points points, std::size_t first, std::size_t last) {
  Region region;
  region.presence = Presence::present;
  region.from = line.speed_ratio[points[first].index];
  region.to = line.speed_ratio[points[last].index];
  region.begins_at_gap = gap_below(line, scale, points[first].index);
  region.ends_at_gap = gap_above(line, scale, points[last].index);
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

/// Fewer points than this are not a stretch that could be judged.
constexpr std::size_t kFewestPoints = 3;

std::size_t count_between(Points points, double above, double below) {
  return static_cast<std::size_t>(std::ranges::count_if(
      points, [=](const ClassifiedPoint& p) { return p.scaled_speed > above && p.scaled_speed < below; }));
}

/// True when there are points enough with a scaled speed in (above, below), and no gap of the line between
/// them.
bool covered(Points points, double above, double below) {
  std::size_t count = 0;
  std::size_t piece = 0;
  for (const auto& point : points) {
    if (point.scaled_speed <= above || point.scaled_speed >= below) continue;
    if (count++ > 0 && point.piece != piece) return false;
    piece = point.piece;
  }
  return count >= kFewestPoints;
}

/// Of the points [from, to), those of the piece of the line that has most points in (above, below).
std::pair<std::size_t, std::size_t> main_piece(Points points, std::size_t from, std::size_t to, double above,
                                               double below) {
  std::pair<std::size_t, std::size_t> best{from, from};
  std::size_t most = 0;
  for (std::size_t first = from; first < to;) {
    std::size_t last = first;
    std::size_t count = 0;
    for (; last < to && points[last].piece == points[first].piece; ++last) {
      if (points[last].scaled_speed > above && points[last].scaled_speed < below) ++count;
    }
    if (count > most) best = {first, last};
    most = std::max(most, count);
    first = last;
  }
  return best;
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

/// Scaled speed that has region 2 below and region 4 above it: the middle of the periodic stretch, between
/// chaos, that covers most of (1/2, 2/3); where none does, 1/2 itself.
double border_of_two_and_four(Points points, const std::vector<Stretch>& stretches) {
  std::vector<bool> chaotic(points.size(), false);
  for (const auto& stretch : stretches) {
    for (std::size_t i = stretch.first; i <= stretch.last; ++i) chaotic[i] = true;
  }
  double border = kBetweenTriggers;
  double most = -1.0;
  for (std::size_t first = 0; first < points.size(); ++first) {
    if (chaotic[first]) continue;
    std::size_t last = first;
    while (last + 1 < points.size() && !chaotic[last + 1] && points[last + 1].piece == points[first].piece)
      ++last;
    const double low = points[first].scaled_speed;
    const double high = points[last].scaled_speed;
    const double covers = std::min(high, kNominalTrigger[1]) - std::max(low, kBetweenTriggers);
    if (covers >= 0.0 && covers > most) {
      most = covers;
      border = 0.5 * (low + high);
    }
    first = last;
  }
  return border;
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
      return begins_at_gap || ends_at_gap ? kNotANumber : to - from;
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
  const double beyond = kNominalTrigger[1] + kTriggerSearch;
  const bool covered_4 = covered(points, kNominalTrigger[1], beyond) && points.back().scaled_speed > beyond;

  const auto stretches = chaotic_stretches(points, kShareWindow, kChaoticShare);
  const double border = border_of_two_and_four(points, stretches);
  const auto second = longest_stretch(points, stretches, start, border);
  const auto fourth = longest_stretch(points, stretches, border, 1e9);

  if (second) {
    regions[1] = region_over(line, scale, points, second->first, second->last);
  } else if (covered_2) {
    regions[1].presence = Presence::absent;
  }

  const bool goes_on = second && points[second->last].scaled_speed >= kNominalTrigger[1];
  if (fourth) {
    regions[3] = region_over(line, scale, points, fourth->first, fourth->last);
  } else if (goes_on) {
    regions[3].presence = Presence::merged;
  } else if (covered_4) {
    regions[3].presence = Presence::absent;
  }

  if (regions[3].presence == Presence::merged) {
    regions[2].presence = Presence::absent;
    return regions;
  }
  if (count_between(points, kBetweenTriggers, kNominalTrigger[1]) < kFewestPoints) return regions;
  const auto [from, to] =
      main_piece(points, second ? second->last + 1 : 0, fourth ? fourth->first : points.size(),
                 kBetweenTriggers, kNominalTrigger[1]);
  if (from < to) regions[2] = region_over(line, scale, points, from, to - 1);
  if (from < to ? regions[2].aperiodic_share >= kChaoticShare : covered_3) {
    regions[2] = {.presence = Presence::absent};
  }
  return regions;
}

}  // namespace rubatlas::analysis

#include "analysis/rules/stretches.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "analysis/rules/gaps.hpp"

namespace rubatlas::analysis {
namespace {

/// Share of aperiodic points in the window around point `i`. The two neighbours always belong to the window,
/// so that no single point decides on a coarse grid.
double running_share(std::span<const ClassifiedPoint> points, std::size_t i, double window) {
  // Speeds of the grid are rounded; a point on the edge of the window belongs to it on both sides.
  const double reach = 0.5 * window * (1.0 + 1e-9);
  std::size_t first = i;
  std::size_t last = i;
  const auto here = [&](std::size_t j) { return points[j].piece == points[i].piece; };
  const auto within = [&](std::size_t j) {
    return here(j) && std::abs(points[j].scaled_speed - points[i].scaled_speed) <= reach;
  };
  while (first > 0 && within(first - 1)) --first;
  while (last + 1 < points.size() && within(last + 1)) ++last;
  if (first == i && i > 0 && here(i - 1)) --first;
  if (last == i && i + 1 < points.size() && here(i + 1)) ++last;
  const auto inside = points.subspan(first, last - first + 1);
  const auto aperiodic = std::ranges::count_if(inside, [](const ClassifiedPoint& p) { return p.aperiodic; });
  return static_cast<double>(aperiodic) / static_cast<double>(inside.size());
}

/// The furthest aperiodic point, half a window at most outwards (by `step`) from `end`, up to which the share
/// holds for the points from `end` on. Where aperiodic motion with windows borders on periodic motion, the
/// running window that straddles the border has less than the share already.
std::size_t grown(std::span<const ClassifiedPoint> points, std::size_t end, std::ptrdiff_t step,
                  double window, double share) {
  std::size_t reached = end;
  std::size_t seen = 0;
  std::size_t aperiodic = 0;
  for (auto i = static_cast<std::ptrdiff_t>(end) + step; i >= 0 && i < std::ssize(points); i += step) {
    const auto& point = points[static_cast<std::size_t>(i)];
    const bool near = std::abs(point.scaled_speed - points[end].scaled_speed) <= 0.5 * window;
    if (point.piece != points[end].piece || !near) break;
    ++seen;
    if (point.aperiodic) ++aperiodic;
    const bool holds = static_cast<double>(aperiodic) >= share * static_cast<double>(seen);
    if (point.aperiodic && holds) reached = static_cast<std::size_t>(i);
  }
  return reached;
}

}  // namespace

std::vector<ClassifiedPoint> classified_points(const Line& line, SpeedScale scale) {
  std::vector<ClassifiedPoint> points;
  std::size_t piece = 0;
  for (std::size_t i = 0; i < line.size() && i < line.motion.size(); ++i) {
    if (i > 0 && is_done(line, i - 1) && gap_above(line, scale, i - 1)) ++piece;
    const bool aperiodic = line.motion[i] == motion_class::kAperiodic;
    if (!aperiodic && !is_periodic(line.motion[i])) continue;
    points.push_back({scale.scaled(line.speed_ratio[i]), aperiodic, i, piece});
  }
  return points;
}

std::vector<Stretch> aperiodic_stretches(std::span<const ClassifiedPoint> points, double window,
                                         double share) {
  std::vector<Stretch> stretches;
  std::size_t i = 0;
  while (i < points.size()) {
    if (running_share(points, i, window) < share) {
      ++i;
      continue;
    }
    Stretch stretch{i, i};
    const auto goes_on = [&] {
      return points[i].piece == points[stretch.first].piece && running_share(points, i, window) >= share;
    };
    while (i < points.size() && goes_on()) stretch.last = i++;
    stretch.first = grown(points, stretch.first, -1, window, share);
    stretch.last = grown(points, stretch.last, +1, window, share);
    while (stretch.first < stretch.last && !points[stretch.first].aperiodic) ++stretch.first;
    while (stretch.last > stretch.first && !points[stretch.last].aperiodic) --stretch.last;
    if (stretch.first == stretch.last) continue;
    if (!stretches.empty() && stretch.first <= stretches.back().last) {
      stretches.back().last = std::max(stretches.back().last, stretch.last);
    } else {
      stretches.push_back(stretch);
    }
  }
  return stretches;
}

double length(std::span<const ClassifiedPoint> points, const Stretch& stretch) {
  return points[stretch.last].scaled_speed - points[stretch.first].scaled_speed;
}

std::vector<Stretch> join_across_windows(std::span<const ClassifiedPoint> points,
                                         std::vector<Stretch> stretches) {
  while (true) {
    auto shortest = stretches.end();
    double shortest_gap = 0.0;
    for (auto left = stretches.begin(); left != stretches.end() && left + 1 != stretches.end(); ++left) {
      const auto right = left + 1;
      const double gap = points[right->first].scaled_speed - points[left->last].scaled_speed;
      const bool is_window = gap < length(points, *left) && gap < length(points, *right);
      if (is_window && (shortest == stretches.end() || gap < shortest_gap)) {
        shortest = left;
        shortest_gap = gap;
      }
    }
    if (shortest == stretches.end()) return stretches;
    shortest->last = (shortest + 1)->last;
    stretches.erase(shortest + 1);
  }
}

}  // namespace rubatlas::analysis

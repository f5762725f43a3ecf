/// Stretches of a line in which the motion is mostly aperiodic.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "analysis/rules/line.hpp"

namespace rubatlas::analysis {

/// One point that counts for the rules: periodic or aperiodic. Unresolved points and points without a class
/// are left out, since they are evidence for neither.
struct ClassifiedPoint {
  double scaled_speed;  ///< Ω n/3 [-]
  bool aperiodic;
  std::size_t index;  ///< on the line
  std::size_t piece;  ///< increases at every gap of the line (gaps.hpp)
};

std::vector<ClassifiedPoint> classified_points(const Line& line, SpeedScale scale);

/// Points [first, last] of a list of classified points; both ends are aperiodic.
struct Stretch {
  std::size_t first;
  std::size_t last;
};

/// Maximal stretches in which the share of aperiodic points, over a window of scaled width `window` centred
/// on each point (and at least its two neighbours), is `share` or more; grown outwards by up to half a window
/// as far as that share holds from its end on; trimmed to begin and end with an aperiodic point. A burst of
/// aperiodic motion shorter than `share` of a window, a single point above all, makes no stretch. Windows and
/// stretches end at the gaps of a line.
std::vector<Stretch> aperiodic_stretches(std::span<const ClassifiedPoint> points, double window,
                                         double share);

/// Joins neighbours where what is between them, a periodic window or points that are not done, is shorter
/// than both of them, shortest gap first, until no such gap is left.
std::vector<Stretch> join_across_windows(std::span<const ClassifiedPoint> points,
                                         std::vector<Stretch> stretches);

/// Length in scaled speed.
[[nodiscard]] double length(std::span<const ClassifiedPoint> points, const Stretch& stretch);

}  // namespace rubatlas::analysis

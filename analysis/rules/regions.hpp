/// Regions 1 to 4 along a line: small motion, aperiodic motion after the first trigger, periodic motion, and
/// aperiodic motion again.
///
/// The rules, in words and with their reasons, are in the README of this folder, "Regions".
#pragma once

#include <array>

#include "analysis/rules/line.hpp"
#include "analysis/rules/triggers.hpp"

namespace rubatlas::analysis {

/// Scaled width of the running share of aperiodic points. A periodic window, or an aperiodic burst, that is
/// shorter than half of it does not end a region.
constexpr double kShareWindow = 1.0 / 20.0;
/// A stretch is aperiodic where at least this share of its running window is aperiodic.
constexpr double kAperiodicMajority = 0.5;
/// The scaled speed midway between the triggers. Region 3 is the periodic stretch that covers most of
/// the range from here to the second trigger.
constexpr double kBetweenTriggers = 0.5;

/// Between which speeds Ω [-] an end lies; NaN where only the grid's points are known.
struct Interval {
  double lower = kNotANumber;
  double upper = kNotANumber;

  [[nodiscard]] bool is_known() const { return lower <= upper; }
};

struct Region {
  Presence presence = Presence::not_covered;
  double from = kNotANumber;                 ///< Ω [-] of the first point
  double to = kNotANumber;                   ///< Ω [-] of the last point
  double aperiodic_share = kNotANumber;      ///< [-] of the points that are periodic or aperiodic
  double peak_displacement = kNotANumber;    ///< [m]
  double median_displacement = kNotANumber;  ///< [m]

  /// The region begins (ends) at a gap of the line, where points are not done, or with the last points of the
  /// line that have a class: it may be longer than its known points.
  bool begins_open = false;
  bool ends_open = false;

  /// Its ends as new points between those of the grid have narrowed them down (borders.hpp).
  Interval from_between{};
  Interval to_between{};

  [[nodiscard]] bool present() const { return presence == Presence::present; }
  /// Extent in Ω [-]; 0 where the region is absent or merged, NaN where it is not covered or open.
  [[nodiscard]] double width() const;
};

/// Regions 1, 2, 3, 4 of a line, in that order.
std::array<Region, 4> find_regions(const Line& line, SpeedScale scale,
                                   const std::array<Trigger, 2>& triggers);

}  // namespace rubatlas::analysis

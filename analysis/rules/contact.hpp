/// Whether any blade touches the ring: at a point, and in one sentence for a line.
///
/// A figure of the contacts that the atlas keeps decides. Without one the sections decide: a motion touches
/// nothing from one section to the next where the second follows from the first by free motion in closed
/// form, within the closing tolerance (class.hpp).
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "analysis/rules/class.hpp"
#include "analysis/rules/line.hpp"
#include "settings/scene.hpp"

namespace rubatlas::analysis {

/// What an atlas keeps of a point that tells of contacts; NaN, or empty, where it keeps it not.
struct ContactEvidence {
  double figure = kNotANumber;         ///< of the contacts: above zero where a blade touches
  double nearest_miss = kNotANumber;   ///< [m] of a tip that passes the ring
  std::span<const double> sections{};  ///< once per revolution, sections × 4
};

/// Contact at a point that is done, of a line whose scene is `line`.
[[nodiscard]] PointContact contact_at(const settings::Scene& line, double speed_ratio,
                                      const ContactEvidence& evidence, const ClosingTolerance& tolerance);

/// True where a blade touches, or may touch since it is not known.
[[nodiscard]] bool may_touch(const Line& line, std::size_t point);

/// Contacts along a line, of its points that are done.
struct ContactSummary {
  std::size_t touching = 0;
  std::size_t free = 0;  ///< points at which nothing touches
  std::size_t not_known = 0;
  double first = kNotANumber;             ///< lowest Ω [-] at which a blade touches
  double last = kNotANumber;              ///< highest
  double closest_distance = kNotANumber;  ///< [m] least distance between tip and ring where nothing touches
  double closest_speed = kNotANumber;     ///< Ω [-] at which it is
  std::string text;  ///< "first contact at Ω = 0.905; elsewhere closest 0.38 mm at Ω = 1"
};
[[nodiscard]] ContactSummary summarise_contact(const Line& line);

}  // namespace rubatlas::analysis

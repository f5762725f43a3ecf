/// Whether any blade touches the ring: at a point, and in one sentence for a line.
///
/// A figure of the contacts that the atlas keeps decides. Without one contact is what the sections and the
/// maximum displacement prove: a blade touches where a section does not follow from the one before by free
/// motion in closed form, within the closing tolerance (class.hpp), or where that motion takes it beyond the
/// ring; none does where the motion keeps all tips off the ring. Sections that follow from each other do not
/// prove that: what a touch leaves may die out before the next section.
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
  double figure = kNotANumber;            ///< of the contacts: above zero where a blade touches
  double nearest_miss = kNotANumber;      ///< [m] of a tip that passes the ring
  double max_displacement = kNotANumber;  ///< [m] of the shaft
  std::span<const double> sections{};     ///< once per revolution, sections × 4
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

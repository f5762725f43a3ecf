/// Whether two motions at the same parameters are the same one, found from different starts.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "analysis/rules/class.hpp"

namespace rubatlas::analysis {

/// Maximum displacements of one aperiodic motion differ by no more than this many standard errors of the
/// difference; by more in one case of twenty.
constexpr double kStandardErrors = 2.0;

/// What of a motion is enough to recognise it.
struct MotionTrace {
  std::uint8_t motion = motion_class::kNone;  ///< class; `kNone` where the point did not end as done
  double max_displacement = 0.0;              ///< [m]
  double displacement_error = 0.0;            ///< standard error of the maximum displacement [m]
  std::array<double, kStateSize> section{};   ///< the last of its sections
};

/// The trace of a motion from its sections (sections × 4) and its maximum displacement. Without sections
/// there is no motion (`kNone`).
///
/// The maximum displacement of an aperiodic motion depends on the revolutions that were sampled. Its standard
/// error is estimated from the sections: the record is cut into ten parts, and the standard deviation of the
/// largest displacement in each is taken. Where displacements have an exponential tail the maximum over a
/// long record scatters as much as that over a short one (Gumbel's distribution), so that the parts need not
/// be as long as the record.
[[nodiscard]] MotionTrace trace_of(std::span<const double> sections, double max_displacement,
                                   const ClosingTolerance& closing);

/// The same where the class of the motion is known.
[[nodiscard]] MotionTrace trace_of(std::uint8_t motion, std::span<const double> sections,
                                   double max_displacement);

/// Whether a motion is that of another trace; `sections` are those of `one`.
///
/// Periodic motions are the same if they have one period and share a section: the last section of the other
/// lies within the closing tolerance of a section of this one. Other motions are the same if they have one
/// class and their maximum displacements differ by no more than two standard errors of the difference. Two
/// points that did not end as done are the same, since what follows them starts from `initial` alike.
[[nodiscard]] bool is_same_motion(const MotionTrace& one, std::span<const double> sections,
                                  const MotionTrace& other, const ClosingTolerance& closing);

}  // namespace rubatlas::analysis

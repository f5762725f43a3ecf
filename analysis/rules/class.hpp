/// The class of a motion: the smallest number of sections after which its states repeat.
///
/// A point's record is its sampled section states (x, y, dx/dτ, dy/dτ), all in metres because τ is
/// dimensionless (MODEL 1). The distance of two states is the Euclidean norm of their difference in all four
/// components; the size of an orbit is the largest norm of its states, that is, their distance from the shaft
/// at rest. Both are unchanged by a rotation of the plane, and scale with the orbit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace rubatlas::analysis {

/// Codes of `/class`; 1 … 16 are periods in sections.
namespace motion_class {
constexpr std::uint8_t kNone = 0;  ///< the point is not done, or nothing was sampled
constexpr std::uint8_t kLongestPeriod = 16;
constexpr std::uint8_t kUnresolved = 254;
constexpr std::uint8_t kAperiodic = 255;
}  // namespace motion_class

[[nodiscard]] constexpr bool is_periodic(std::uint8_t motion) {
  return motion >= 1 && motion <= motion_class::kLongestPeriod;
}

/// Components of a section state.
constexpr std::size_t kStateSize = 4;

/// Two states are equal within max(relative · size of the orbit, floor).
struct ClosingTolerance {
  double relative = 1e-6;  ///< [-] of the orbit's size
  double floor = 0.0;      ///< [m] the error that the integrator may make
};

/// An orbit that closes within this many tolerances, but not within one, is unresolved.
constexpr double kUnresolvedFactor = 100.0;

/// Largest norm of the states [m]; `states` is sections × 4, NaN when a value is NaN.
[[nodiscard]] double orbit_size(std::span<const double> states);

/// Largest distance [m] between states `period` sections apart; needs more than `period` sections.
[[nodiscard]] double closing_distance(std::span<const double> states, std::size_t period);

/// Class of a record (sections × 4).
///
/// Periodic with period p: p is the smallest of 1 … 16 whose closing distance is within the tolerance, over
/// the whole record and over each of its halves alone. Aperiodic: no period closes within 100 tolerances,
/// over the whole or a half. Unresolved: everything else, that is, orbits that nearly close and orbits whose
/// halves differ. A half can test a period only if it is longer than the period. A record shorter than 34
/// sections is therefore never called aperiodic, and one shorter than 4 is always unresolved. An empty
/// record, or one with a value that is not finite, is `kNone`.
[[nodiscard]] std::uint8_t classify(std::span<const double> states, const ClosingTolerance& closing);

}  // namespace rubatlas::analysis

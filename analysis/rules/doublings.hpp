/// Period doublings along a line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rubatlas::analysis {

/// A period p that becomes 2p as the speed grows.
struct PeriodDoubling {
  double speed_ratio;        ///< Ω [-], midway between the two runs
  std::uint8_t from_period;  ///< p, in sections
};

/// Smallest number of consecutive points with the same period that make a run; a single point is none. One
/// point of the doubled period is enough where the cascade goes on from it: to a further doubling, to an
/// unresolved motion or to aperiodic motion.
constexpr std::size_t kShortestRun = 2;
/// Points between two runs that are allowed to have no class or to be unresolved: close to a doubling the
/// motion settles slowly.
constexpr std::size_t kLongestDoubt = 5;

/// All period doublings, ascending in Ω; `speed_ratio` and `motion` (classes) have one entry per point.
std::vector<PeriodDoubling> period_doublings(std::span<const double> speed_ratio,
                                             std::span<const std::uint8_t> motion);

}  // namespace rubatlas::analysis

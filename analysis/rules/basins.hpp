/// How large the basins of attraction are: which share of the initial states leads to which attractor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "analysis/rules/starts.hpp"

namespace rubatlas::analysis {

/// What the rules say of every point of an atlas.
struct PointsOfAtlas {
  std::span<const std::uint8_t> status;
  std::span<const std::uint8_t> motion;      ///< class per revolution
  std::span<const std::int32_t> attractor;   ///< `Attractors::numbers`
  std::span<const double> max_displacement;  ///< [m]
};

/// The initial states, at the same parameters, that lead to one attractor.
struct Basin {
  std::size_t set = 0;            ///< of `Starts`
  std::int32_t attractor = 0;     ///< 0: the initial states whose motion has no attractor
  std::uint8_t motion = 0;        ///< class of the attractor; 0 without one
  std::size_t points = 0;         ///< initial states that lead there
  double share = 0.0;             ///< of the set's points that are not pending [-]
  double standard_error = 0.0;    ///< of the share, binomial: √(p (1 − p)/N)
  double max_displacement = 0.0;  ///< largest on the attractor [m]; NaN without one
};

/// Sorted by set, then by attractor, those without one last. Sets of pending points have none.
[[nodiscard]] std::vector<Basin> find_basins(const Starts& starts, const PointsOfAtlas& points);

}  // namespace rubatlas::analysis

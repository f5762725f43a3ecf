/// Where a sweep up and a sweep down find different motions at the same parameters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rubatlas::analysis {

/// Speeds of a line, next to each other, at which the motions differ. Speeds at which one of the motions has
/// no attractor are not compared: they neither belong to a range nor divide it.
struct HysteresisRange {
  std::size_t line = 0;  ///< among the lines of one direction
  double from = 0.0;     ///< first and last Ω at which they differ [-]
  double to = 0.0;
  std::size_t speeds = 0;  ///< at which they differ
  /// Classes of the motions of the sweep up at these speeds, each once, ascending.
  std::vector<std::uint8_t> up = {};
  std::vector<std::uint8_t> down = {};  ///< the same of the sweep down

  /// At all of these speeds the one motion may be the other with other blades touching (`may_be_shifted`).
  bool may_be_shifted = true;

  /// Both are aperiodic at all of these speeds, so that only their statistics tell them apart.
  [[nodiscard]] bool is_aperiodic() const;
};

struct Hysteresis {
  std::vector<HysteresisRange> ranges;
  std::size_t compared = 0;             ///< pairs of motions
  std::size_t different = 0;            ///< of these pairs
  std::size_t compared_aperiodic = 0;   ///< pairs of aperiodic motions
  std::size_t different_aperiodic = 0;  ///< of these pairs
};

/// `motion` (class), `attractor` and `max_displacement` [m] have one entry per point of an atlas that was
/// swept both ways: first all lines of the sweep up, then those of the sweep down. `speed_ratio` is that of
/// the points of a line.
[[nodiscard]] Hysteresis find_hysteresis(std::span<const double> speed_ratio,
                                         std::span<const std::uint8_t> motion,
                                         std::span<const std::int32_t> attractor,
                                         std::span<const double> max_displacement);

}  // namespace rubatlas::analysis

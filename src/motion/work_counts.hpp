/// What a motion has cost, in counts.
#pragma once

#include <cstdint>

namespace rubatlas::motion {

/// Counts of the work of a point; never part of the atlas.
struct WorkCounts {
  std::uint64_t revolutions = 0;  ///< completed
  std::uint64_t right_hand_sides = 0;
  std::uint64_t steps = 0;
  std::uint64_t rejected_steps = 0;
  std::uint64_t touchdowns = 0;
  std::uint64_t liftoffs = 0;
  std::uint64_t slip_reversals = 0;
  std::uint64_t slip_accumulations = 0;    ///< of reversals, after which a tip comes to rest
  std::uint64_t gap_evaluations = 0;       ///< in flight
  std::uint64_t elastica_evaluations = 0;  ///< of the blade's curve, in all modes and at resets
  std::int64_t price = 0;                  ///< of all this work, as in `modes/work_meter.hpp` [ns]

  WorkCounts& operator+=(const WorkCounts& more) {
    revolutions += more.revolutions;
    right_hand_sides += more.right_hand_sides;
    steps += more.steps;
    rejected_steps += more.rejected_steps;
    touchdowns += more.touchdowns;
    liftoffs += more.liftoffs;
    slip_reversals += more.slip_reversals;
    slip_accumulations += more.slip_accumulations;
    gap_evaluations += more.gap_evaluations;
    elastica_evaluations += more.elastica_evaluations;
    price += more.price;
    return *this;
  }
};

}  // namespace rubatlas::motion

/// Numbers of several attempts, one in each SIMD lane: what the arithmetic reads and writes.
#pragma once

#include <array>

#include "batch/lane_request.hpp"

namespace rubatlas::batch {

/// One number of each lane.
template <int kLanes>
struct LaneVector;
template <>
struct LaneVector<4> {
  using Type [[gnu::vector_size(32)]] = double;
};
template <>
struct LaneVector<8> {
  using Type [[gnu::vector_size(64)]] = double;
};

// Plain arrays here and in the arithmetic: functions of std::array that are compiled behind a target's pragma
// could be linked in where others call them, on a processor that does not know them.
// NOLINTBEGIN(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)
template <int kLanes>
struct LaneBlock {
  using Lanes = typename LaneVector<kLanes>::Type;

  Lanes start[6], stages[kEvaluationsOfAttempt + 1][6], end[6], size;
  // Of the motion, and of its contact.
  Lanes speed, damping, force_unit, misalignment, reach, closing, length, load_unit, strain_unit, friction,
      mirror, scale, slip, anchor_time, anchor_cosine, anchor_sine;
  // Of the last evaluation.
  Lanes force_radial, force_tangential, load, shortening, root_strain, slip_velocity, residual, bending_slope,
      time_slope, acceleration_x, acceleration_y;
  std::array<const LaneRequest*, kLanes> request;  ///< whose numbers these are
  std::array<const blade::ElasticaCurve*, kLanes> curve;
  bool any_unbalance;
};
// NOLINTEND(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)

/// The stages and the end of all attempts of a block, from its first stages. For processors that can.
void attempt_avx2(LaneBlock<4>& block);
void attempt_avx512(LaneBlock<8>& block);

}  // namespace rubatlas::batch

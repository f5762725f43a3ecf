/// Numbers of several attempts, one in each SIMD lane: what the arithmetic reads and writes.
///
/// Rows of plain numbers, laid out alike for every processor that a source is compiled for. Functions of
/// `std::array` that are compiled for one of them could be linked in where others call them, on a processor
/// that does not know its instructions: plain arrays.
#pragma once

#include "blade/elastica_curve.hpp"
#include "integrate/dormand_prince_853.hpp"

// NOLINTBEGIN(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)
namespace rubatlas::batch {

struct LaneRequest;

/// An attempt evaluates that many right-hand sides.
constexpr int kEvaluationsOfAttempt = integrate::DormandPrince853::kStages;

template <int kLanes>
struct LaneBlock {
  /// One number of each lane.
  struct alignas(kLanes * sizeof(double)) Row {
    double lane[kLanes];
  };

  Row start[6], stages[kEvaluationsOfAttempt + 1][6], end[6], size;
  // Of the motion, and of its contact.
  Row speed, damping_ratio, force_unit, misalignment, reach, ring_radius, length, load_unit, strain_unit,
      friction, mirror, scale, slip, anchor_time, anchor_cosine, anchor_sine;
  // Of the last evaluation.
  Row force_radial, force_tangential, load, shortening, root_strain, slip_velocity, residual, bending_slope,
      time_slope, acceleration_x, acceleration_y;
  const LaneRequest* request[kLanes];  ///< whose numbers these are
  const blade::ElasticaCurve* curve[kLanes];
  bool any_unbalance;
};

/// (cosine, sine) of the blade of a lane at a time so far from its anchor that the series does not hold.
void direct(const LaneRequest& request, double time, double& cosine, double& sine);
/// Adds the unbalance of a lane that has one; to the others −0, which changes no number.
void unbalance(const LaneRequest& request, double time, double& x, double& y);

/// The stages and the end of all attempts of a block, from its first stages. For processors that can.
void attempt_avx2(LaneBlock<4>& block);
void attempt_avx512(LaneBlock<8>& block);

}  // namespace rubatlas::batch
// NOLINTEND(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)

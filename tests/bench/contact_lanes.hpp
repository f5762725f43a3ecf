/// Attempts of contact steps of several independent motions at once, one in each SIMD lane.
///
/// The lanes do the operations of `CarriedContact` and `RungeKutta::attempt` in the same order, so that each
/// has the bits of the scalar path. Motions may differ in everything: speed, damping, friction, blade.
/// Needs AVX-512 for eight lanes, AVX2 for four; asks the processor nothing (README).
#pragma once

#include <array>
#include <span>

#include "effects/harmonic.hpp"
#include "integrate/dormand_prince_853.hpp"
#include "integrate/runge_kutta.hpp"
#include "solve/contact_system.hpp"

namespace rubatlas::bench {

using LaneSystem = solve::CarriedContact<effects::NoForcing>;
using LaneStep = integrate::RungeKutta<integrate::DormandPrince853, 6>;

/// One attempt that a motion asks for: a system that is open and anchored at the start of a step that has
/// begun.
struct LaneRequest {
  LaneSystem* system;
  LaneStep* step;
  double size;
};

/// One number of each lane.
template <int kLanes>
struct LaneVector;
template <>
struct LaneVector<4> {
  typedef double Type __attribute__((vector_size(32)));
};
template <>
struct LaneVector<8> {
  typedef double Type __attribute__((vector_size(64)));
};

template <int kLanes>
class ContactLanes {
 public:
  /// Takes from 1 to `kLanes` requests; lanes left over repeat the first.
  void pack(std::span<const LaneRequest> requests);
  /// Makes the stages and the end of all of them.
  void attempt();
  /// Gives steps and systems what their own attempt would have left there; true per lane where it would have
  /// returned true.
  std::array<bool, kLanes> unpack();

 private:
  using Lanes = typename LaneVector<kLanes>::Type;
  struct Arithmetic;

  Lanes start_[6], stages_[13][6], end_[6], size_;
  // Of the motion, and of its contact.
  Lanes speed_, damping_, force_unit_, misalignment_, reach_, closing_, length_, load_unit_, strain_unit_,
      friction_, mirror_, scale_, slip_, anchor_time_, anchor_cosine_, anchor_sine_;
  // Of the last evaluation.
  Lanes force_radial_, force_tangential_, load_, shortening_, root_strain_, slip_velocity_, residual_,
      bending_slope_, time_slope_, acceleration_x_, acceleration_y_;
  std::array<LaneRequest, kLanes> request_;
  std::array<const blade::ElasticaCurve*, kLanes> curve_;
  int count_ = 0;
};

}  // namespace rubatlas::bench

/// Where the tips of a motion's blades stand in a state between or within modes.
#pragma once

#include "contact/pose.hpp"
#include "modes/contact_setup.hpp"
#include "modes/law.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::modes {

class TipPlaces {
 public:
  explicit TipPlaces(const ContactSetup& setup) : machine_(setup.machine), law_(setup.law) {}

  [[nodiscard]] const rotor::Machine& machine() const { return *machine_; }
  [[nodiscard]] const rotor::RotorConstants& rotor() const { return machine_->constants; }
  [[nodiscard]] const rotor::BladeSet& blades() const { return machine_->blades; }
  [[nodiscard]] double ring_radius() const { return law_->geometry(0).ring_radius; }
  /// |v| of a slip reversal that has been located [m per unit τ].
  template <class State>
  [[nodiscard]] double slip_rounding(const State& state) const {
    return contact::slip_rounding(rotor().speed_ratio * ring_radius(), state[2], state[3]);
  }

  /// Direction of blade 0 in a state.
  template <class State>
  [[nodiscard]] contact::BladeDirection first_blade(const State& state) const {
    return blades().first(state[rotor::kTime]);
  }
  template <class State>
  [[nodiscard]] double angular_speed(const State& state) const {
    return blades().angular_speed(state[rotor::kTime]);
  }
  template <class State>
  [[nodiscard]] contact::Pose pose(int blade, const State& state) const {
    return pose(blade, state, first_blade(state));
  }
  /// The same when blade 0 stands at `first`, for all blades in one state.
  template <class State>
  [[nodiscard]] contact::Pose pose(int blade, const State& state,
                                   const contact::BladeDirection& first) const {
    return rotor::pose_of(rotor(), law_->geometry(blade), blades().direction(blade, first),
                          rotor::from_ring(state));
  }
  template <class State>
  [[nodiscard]] TipPlace tip_place(int blade, const State& state) const {
    return {pose(blade, state), angular_speed(state)};
  }

 protected:
  const rotor::Machine* machine_;
  const Law* law_;
};

}  // namespace rubatlas::modes

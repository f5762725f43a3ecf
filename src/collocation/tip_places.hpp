/// Where the tips of blades stand in a state between or within contacts.
#pragma once

#include "collocation/law.hpp"
#include "contact/pose.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::collocation {

class TipPlaces {
 public:
  /// Machine and law outlive it.
  TipPlaces(const rotor::Machine& machine, const Law& law) : machine_(&machine), law_(&law) {}

  [[nodiscard]] const rotor::Machine& machine() const { return *machine_; }
  [[nodiscard]] const rotor::RotorConstants& rotor() const { return machine_->constants; }
  [[nodiscard]] const rotor::BladeSet& blades() const { return machine_->blades; }
  [[nodiscard]] double ring_radius() const { return law_->geometry(0).ring_radius; }
  // `state`: any that begins with x, y, x', y', τ, or, for the first of these, x, y, x', y'.

  /// |v| of a slip reversal that has been located [m per unit τ].
  [[nodiscard]] double slip_rounding(const auto& state) const {
    return contact::slip_rounding(rotor().speed_ratio * ring_radius(), state[2], state[3]);
  }
  [[nodiscard]] contact::BladeDirection direction(int blade, const auto& state) const {
    return blades().direction(blade, blades().first(state[rotor::kTime]));
  }
  [[nodiscard]] double angular_speed(const auto& state) const {
    return blades().angular_speed(state[rotor::kTime]);
  }
  [[nodiscard]] contact::Pose pose(int blade, const auto& state, const contact::BladeDirection& er) const {
    return rotor::pose_of(rotor(), law_->geometry(blade), er, rotor::from_ring(state));
  }
  [[nodiscard]] contact::Pose pose(int blade, const auto& state) const {
    return pose(blade, state, direction(blade, state));
  }
  [[nodiscard]] TipPlace tip_place(int blade, const auto& state) const {
    return {pose(blade, state), angular_speed(state)};
  }

 protected:
  const rotor::Machine* machine_;
  const Law* law_;
};

}  // namespace rubatlas::collocation

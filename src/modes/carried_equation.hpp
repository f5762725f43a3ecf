/// The equation of the mode `Carried`, for one motion or for several side by side, one in each SIMD lane.
#pragma once

#include <type_traits>

#include "contact/pose.hpp"
#include "modes/open_contact.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"

namespace rubatlas::modes {

/// All that d/dσ of x, y, x', y', τ, u depends on besides the state (`carried.hpp` has the equations). What
/// the parts are asked for: `Rotor` the constants of `shaft_acceleration` and `pose_of`, `Blades`
/// `direction_near` and `angular_speed`, `Law` `geometry` and `constraint`, `Forcing` as `rotor/harmonic.hpp`
/// has it.
template <class Number, class Rotor, class Blades, class Law, class Forcing>
struct CarriedEquation {
  const Rotor* rotor = nullptr;
  const Blades* blades = nullptr;
  const Law* law = nullptr;  ///< of the carried blade
  const Forcing* forcing = nullptr;
  Number slip = 1.0;                 ///< s of the carried contact
  Number scale = 1.0;                ///< unit of σ against the rates of h [1/m²]
  typename Blades::Anchor anchor{};  ///< where the blade stood when the step began

  /// Writes the derivative, the `constraint` of the carried blade and the `acceleration` of all that moves.
  /// `add_others(constraint, force)` adds the forces of the blades that touch besides [N]; where it returns
  /// false one of them has none, and neither has the state a derivative.
  template <class State, class Constraint, class Acceleration, class AddOthers>
  bool evaluate(const State& state, State& derivative, Constraint& constraint, Acceleration& acceleration,
                AddOthers add_others) const {
    const auto er = blades->direction_near(anchor, state[rotor::kTime]);
    constraint = law->constraint(rotor::pose_of(*rotor, law->geometry(), er, rotor::from_ring(state)), slip,
                                 state[rotor::kBending], blades->angular_speed(state[rotor::kTime]));
    auto force = contact::on_rotor(constraint.force, er);
    if (!add_others(constraint, force)) return false;
    acceleration = rotor::acceleration_of_all(state, *forcing,
                                              modes::acceleration(*rotor, *forcing, state, force), force);
    const Number time_rate = -scale * constraint.bending_slope;
    derivative = rotor::full_state((time_rate * rotor::rate_of(state, acceleration)).eval(), time_rate,
                                   Number(scale * constraint.time_slope));
    return true;
  }
};

}  // namespace rubatlas::modes

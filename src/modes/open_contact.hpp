/// A blade in contact, and its force where it stands.
#pragma once

#include <complex>
#include <limits>

#include "contact/pose.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"

namespace rubatlas::modes {

/// A contact that is open: which blade, its slip direction s = ±1 (0 where it sticks) and, for elastic
/// blades, its bending parameter.
struct OpenContact {
  int blade;
  double slip;
  double bending;
  double amplitude = 0.0;  ///< φ, the second unknown of a blade under an inclined load; 0: not known
  double yielding = 0.0;   ///< y of a ring with dampers under the tip [m]; 0: a new contact
  bool straight = false;   ///< the blade does not bend, and only the ring yields under it
  /// τ of the last slip reversal, and of the one before.
  double reversed = -std::numeric_limits<double>::infinity();
  double reversed_before = -std::numeric_limits<double>::infinity();
};

/// g and dg/dτ of a blade.
struct BladeGap {
  double value;  ///< [m²]
  double rate;   ///< [m² per unit τ]
};

constexpr double kGapRounding = 1e-17;   ///< [m²]: g where a touch-down or a lift-off has been located
constexpr double kSlipRounding = 1e-12;  ///< of Ω R: |v| where a slip reversal has been located

/// A law under which h = 0 may have several roots, or lose the one that it has.
template <class Law>
inline constexpr bool kMayHaveBranches = requires {
  requires Law::kMayHaveBranches;
};

/// The force of an open contact where its blade stands; updates its guesses. False where there is none.
template <class Law>
bool respond(const Law& law, const contact::Pose& at, double speed, OpenContact& contact,
             contact::TipForce& force) {
  if constexpr (requires {
                  law.respond(at, contact.slip, speed, contact.bending, contact.amplitude, force);
                }) {
    return law.respond(at, contact.slip, speed, contact.bending, contact.amplitude, force);
  } else {
    return law.respond(at, contact.slip, speed, contact.bending, force);
  }
}

/// Force on the rotor along x (real) and y of a tip whose blade stands at `er` [N].
inline std::complex<double> on_rotor(const contact::TipForce& force, const contact::BladeDirection& er) {
  return {force.radial * er.cosine - force.tangential * er.sine,
          force.radial * er.sine + force.tangential * er.cosine};
}

/// x'' and y'' [m per unit τ²] from a force on the rotor in newtons.
template <class Forcing>
std::complex<double> acceleration(const rotor::RotorConstants& rotor, const Forcing& forcing,
                                  const rotor::FullStateOf<Forcing>& state, double force_x, double force_y) {
  if constexpr (rotor::kRingMoves<Forcing>) {
    return acceleration(rotor, forcing.shaft, rotor::ContactState(state.template head<6>()), force_x,
                        force_y);
  } else if constexpr (requires { Forcing::kAnySupport; }) {
    return forcing.support.acceleration(state[rotor::kTime], state.template head<4>().matrix()) +
           rotor.force_unit * std::complex<double>(force_x, force_y);
  } else {
    const double damping = 2.0 * rotor.damping_ratio;
    std::complex<double> result(force_x * rotor.force_unit - damping * state[2] - state[0],
                                force_y * rotor.force_unit - damping * state[3] - state[1]);
    if constexpr (Forcing::kPresent) result += forcing.acceleration(state[rotor::kTime]);
    return result;
  }
}

}  // namespace rubatlas::modes

/// Power of friction at a tip, under any contact law.
#pragma once

#include <cmath>

#include "contact/pose.hpp"

namespace rubatlas::modes {

/// |c F v| [J per unit τ]: c the friction coefficient, v the slip velocity (MODEL 4.3, 4.4). `law`: the
/// contact law of the blade.
template <class Law>
double friction_power(const Law& law, const contact::TipForce& force) {
  double coefficient = 0.0;
  if constexpr (requires { law.friction().coefficient(force.slip_velocity, 1.0); }) {
    coefficient = law.friction().coefficient(force.slip_velocity, 1.0);
  } else {
    coefficient = law.curve().friction();
  }
  return std::abs(coefficient * force.normal * force.slip_velocity);
}

}  // namespace rubatlas::modes

/// What turns and pushes the shaft on one line, as types: the forcing and the blades of a point.
///
/// A machine makes both for a speed ratio. The paper's rotor has a machine without forcing and one with an
/// unbalance, and nothing else in its equations.
#pragma once

#include "rotor/blade_set.hpp"
#include "rotor/harmonic.hpp"

namespace rubatlas::assembly {

/// Equal blades at constant speed, nothing but shaft and ring.
struct PlainMachine {
  static constexpr bool kMayChange = false;
  int blade_count;
  [[nodiscard]] rotor::NoForcing forcing(double /*speed_ratio*/) const { return {}; }
  [[nodiscard]] rotor::BladeSet blades(double speed_ratio) const { return {blade_count, speed_ratio}; }
};

/// The same with an unbalance.
struct UnbalancedMachine {
  static constexpr bool kMayChange = false;
  int blade_count;
  double specific_moment;  ///< me/m [m]
  double phase;            ///< γ [rad]
  double damping_ratio;    ///< ζ [-]
  [[nodiscard]] rotor::RotatingUnbalance forcing(double speed_ratio) const {
    return {specific_moment, phase, speed_ratio, damping_ratio};
  }
  [[nodiscard]] rotor::BladeSet blades(double speed_ratio) const { return {blade_count, speed_ratio}; }
};

}  // namespace rubatlas::assembly

/// The constants of one grid point, as the equations of motion use them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "contact/pose.hpp"

namespace rubatlas::rotor {

/// x, y, dx/dτ, dy/dτ [m].
using State = Eigen::Array4d;

inline std::array<double, 4> as_array(const State& state) {
  return {state[0], state[1], state[2], state[3]};
}
inline State as_state(const std::array<double, 4>& state) {
  return {state[0], state[1], state[2], state[3]};
}

struct RotorConstants {
  double speed_ratio;    ///< Ω [-]
  double damping_ratio;  ///< ζ [-]
  double misalignment;   ///< y0 [m]
  double force_unit;     ///< 1/(m ωn²) [m/N]: acceleration per unit τ² of one newton
  double length_scale;   ///< δc, or L/10 where δc = 0 [m]: what tolerances are relative to

  /// τ of one revolution. A negative speed ratio is a spin the other way, the mirror image.
  [[nodiscard]] double period() const { return 2.0 * std::numbers::pi / std::abs(speed_ratio); }
  /// Rounding of g where the tips of such blades touch [m²].
  [[nodiscard]] double gap_rounding(const contact::Geometry& blade) const {
    return blade.gap_rounding(length_scale + std::abs(misalignment));
  }
};

/// Pose of a blade for a state of the rotor.
inline contact::Pose pose_of(const RotorConstants& rotor, const contact::Geometry& geometry,
                             const contact::BladeDirection& direction, const State& state) {
  return contact::pose(geometry, direction, state[0], state[1] + rotor.misalignment, state[2], state[3]);
}

/// z'' [m per unit τ²] of a shaft on an isotropic support under a force [N] (MODEL 1).
inline std::complex<double> shaft_acceleration(const RotorConstants& rotor, const State& state,
                                               const std::complex<double>& force) {
  const double damping = 2.0 * rotor.damping_ratio;
  return {force.real() * rotor.force_unit - damping * state[2] - state[0],
          force.imag() * rotor.force_unit - damping * state[3] - state[1]};
}

}  // namespace rubatlas::rotor

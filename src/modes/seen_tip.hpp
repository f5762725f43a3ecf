/// What observables see of a tip: where it is against the ring, and what its force does to the rotor, under
/// any contact law.
#pragma once

#include <cmath>
#include <complex>

#include "contact/tip.hpp"
#include "trajectory/motion_piece.hpp"

namespace rubatlas::modes {

/// The tip of an undeformed blade against the ring.
inline trajectory::Tip tip_of(const contact::Geometry& geometry, const contact::Pose& at,
                              double angular_speed) {
  const double radius = geometry.ring_radius;
  // |tip|² = R² + g
  const double distance = std::sqrt(std::fmax(radius * radius + at.gap, 0.0));
  const double slip = contact::undeformed_slip_velocity(geometry, at, angular_speed);
  return {at.gap / (radius + distance), 0.5 * contact::gap_rate(geometry, at, angular_speed) / distance,
          std::copysign(1.0, slip) * at.tangential};
}

/// `slip`: s = ±1, 0 where the tip sticks; `coefficient`: c [-]; `at`, `er`: where the blade stands;
/// `angular_speed`: of the rotor, per unit τ.
///
/// Fk = −F (n + c t), and the deformed tip stands at rk = |rk| n from the ring's centre. Seen from the
/// shaft's centre c it stands at rk − c, of which (rk − c)·t = −c·t, and Ω (rk − c)·n = v − c'·t (MODEL 4.4).
/// Hence the torque (rk − c) × Fk = −F c·t − c F (v − c'·t)/Ω, whatever bends or yields.
inline trajectory::ContactForce contact_force(const contact::TipForce& force, double slip, double coefficient,
                                              const contact::BladeDirection& er, const contact::Pose& at,
                                              double angular_speed) {
  // All along and across the blade.
  using Complex = std::complex<double>;
  const Complex normal = Complex(coefficient * force.tangential + force.radial,
                                 force.tangential - coefficient * force.radial) *
                         (-1.0 / (1.0 + coefficient * coefficient));  // F n
  const Complex tangent(-normal.imag(), normal.real());               // F t
  const auto along_tangent = [&](double radial, double tangential) {
    return radial * tangent.real() + tangential * tangent.imag();
  };
  const double slips_by_turning =
      force.normal * force.slip_velocity - along_tangent(at.radial_velocity, at.tangential_velocity);
  const double torque =
      -along_tangent(at.radial, at.tangential) - coefficient * slips_by_turning / angular_speed;
  const Complex on_rotor = contact::on_rotor(force, er);
  return {on_rotor, force.normal, force.slip_velocity, slip, coefficient, torque, force.root_strain};
}

}  // namespace rubatlas::modes

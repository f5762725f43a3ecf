/// The equations of a tip on the ring (MODEL 4.1, 4.3, 4.4), each written once over a number: `double`, eight
/// nodes in lanes (`collocation`), or a number that carries its slopes (`variation`).
///
/// All as seen from the turning blade, along it (er) and across it (et). The tip of a blade that does not
/// bend lies at (cr + rh + L, ct) from the ring's centre. Bending takes (δ, s Δ) off that.
#pragma once

#include <cmath>
#include <complex>

#include "contact/pose.hpp"

namespace rubatlas::contact {

/// A vector along (er) and across (et) a blade.
template <class Number>
struct BladeVector {
  Number along, across;

  friend BladeVector operator+(const BladeVector& one, const BladeVector& other) {
    return {one.along + other.along, one.across + other.across};
  }
  friend BladeVector operator-(const BladeVector& one, const BladeVector& other) {
    return {one.along - other.along, one.across - other.across};
  }
  template <class Factor>
  friend BladeVector operator*(const BladeVector& vector, const Factor& factor) {
    return {vector.along * factor, vector.across * factor};
  }
  friend BladeVector operator/(const BladeVector& vector, const Number& divisor) {
    return {vector.along / divisor, vector.across / divisor};
  }
};
template <class Number>
Number dot(const BladeVector<Number>& one, const BladeVector<Number>& other) {
  return one.along * other.along + one.across * other.across;
}
/// The length of one times the component of the other across it.
template <class Number>
Number cross(const BladeVector<Number>& one, const BladeVector<Number>& other) {
  return one.along * other.across - one.across * other.along;
}
inline double magnitude(const BladeVector<double>& vector) {
  return std::sqrt(dot(vector, vector));
}

/// Where the tip of the unbent blade lies from the ring's centre [m].
template <class Number>
BladeVector<Number> unbent_tip(const Geometry& geometry, const PoseOf<Number>& at) {
  return {at.radial + geometry.reach, at.tangential};
}
/// Rate of the tip as long as the blade keeps its bend [m per unit τ].
template <class Number, class Speed>
BladeVector<Number> tip_rate(const PoseOf<Number>& at, const Speed& angular_speed) {
  return {at.radial_velocity + at.tangential * angular_speed,
          at.tangential_velocity - at.radial * angular_speed};
}

/// How that changes where the shaft's centre moves with `acceleration` [m per unit τ²], at constant speed.
template <class Number, class Speed>
BladeVector<Number> tip_acceleration(const PoseOf<Number>& at, const Speed& angular_speed,
                                     const BladeVector<Number>& acceleration) {
  return {acceleration.along + (at.tangential_velocity * 2.0 - at.radial * angular_speed) * angular_speed,
          acceleration.across - (at.radial_velocity * 2.0 + at.tangential * angular_speed) * angular_speed};
}

/// h = |tip|² − R² [m²], from g, so that a light contact keeps its digits. `unbent`: where the tip of the
/// unbent blade lies, `bent`: (δ, s Δ) [m].
template <class Number>
Number contact_equation(const Number& gap, const BladeVector<Number>& unbent,
                        const BladeVector<Number>& bent) {
  return gap +
         (bent.along * (bent.along - unbent.along * 2.0) + bent.across * (bent.across - unbent.across * 2.0));
}
/// (R + y)² − R² [m²], which a ring that yields by y takes off h.
template <class Number>
Number widening(const Number& yielding, double ring_radius) {
  return yielding * (yielding + 2.0 * ring_radius);
}
/// What |tip|² changes by where the tip does.
template <class Number>
Number square_change(const BladeVector<Number>& tip, const BladeVector<Number>& change) {
  return dot(tip, change) * 2.0;
}

/// v [m per unit τ] of a tip at the distance `radius` from the ring's centre.
template <class Number, class Speed, class PerRadius, class Radius>
Number slip_velocity(const BladeVector<Number>& tip, const BladeVector<Number>& rate, const Speed& speed,
                     const PerRadius& per_radius, const Radius& radius) {
  return cross(tip, rate) * per_radius + speed * radius;
}

/// −(n + c Jn) times the length of `tip`, n its direction, J a quarter turn: where a ring pushes that presses
/// on the tip under the friction coefficient c.
template <class Number, class Coefficient>
BladeVector<Number> push_direction(const BladeVector<Number>& tip, const Coefficient& coefficient) {
  return {tip.across * coefficient - tip.along, (tip.along * coefficient + tip.across) * -1.0};
}

/// v of the tip of an unbent blade, in the direction n from the ring's centre.
template <class Number, class Speed>
Number undeformed_slip_velocity(const BladeVector<Number>& normal, const PoseOf<Number>& at,
                                const Speed& angular_speed, double reach) {
  return (normal.along * at.tangential_velocity - normal.across * at.radial_velocity) +
         angular_speed * normal.along * reach;
}
/// The same, which gives the slip direction of a new contact.
inline double undeformed_slip_velocity(const Geometry& geometry, const Pose& at, double angular_speed) {
  const BladeVector<double> tip = unbent_tip(geometry, at);
  return undeformed_slip_velocity(tip / magnitude(tip), at, angular_speed, geometry.reach);
}

/// What a contact does: the force on the rotor, resolved along and across the blade, and what is recorded of
/// it.
struct TipForce {
  double radial;         ///< Fk·er [N]
  double tangential;     ///< Fk·et [N]
  double normal;         ///< F [N]
  double shortening;     ///< δ/L [-]
  double root_strain;    ///< bending strain at the root [-]; 0 for a rigid blade
  double slip_velocity;  ///< v of the deformed tip [m per unit τ]
};

/// Force on the rotor along x and y of a tip whose blade stands at `er` [N].
inline std::complex<double> on_rotor(const TipForce& force, const BladeDirection& er) {
  return {force.radial * er.cosine - force.tangential * er.sine,
          force.radial * er.sine + force.tangential * er.cosine};
}

/// Force of a tip that slips with v under the normal load F [N] and the friction coefficient c; without what
/// is recorded of a blade that bends.
inline TipForce tip_force(const BladeVector<double>& tip, double distance, double slip_velocity, double load,
                          double coefficient) {
  const BladeVector<double> push = push_direction(tip / distance, coefficient) * load;
  return {push.along, push.across, load, 0.0, 0.0, slip_velocity};
}
/// The same where v is that of the tip of a bent blade, which moves with `rate` if the bend stays.
inline TipForce bent_tip_force(const BladeVector<double>& tip, const BladeVector<double>& rate,
                               double angular_speed, double load, double coefficient) {
  const double distance = magnitude(tip);
  return tip_force(tip, distance, slip_velocity(tip, rate, angular_speed, 1.0 / distance, distance), load,
                   coefficient);
}

}  // namespace rubatlas::contact

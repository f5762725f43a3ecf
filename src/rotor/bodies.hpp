/// What moves: the shaft alone, or the shaft and the ring as a body. The state of either, in flight and in
/// contact, and what contacts see of it.
///
/// A contact depends on where the shaft is as seen from the ring, z − r and z' − r'. In flight and between
/// phases a state has the shaft's four numbers and the ring's four behind them; in contact, time and bending
/// parameter stand between the two, so that they have the same places with and without a ring that moves.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <type_traits>
#include <utility>

#include "rotor/constants.hpp"
#include "rotor/ring_body.hpp"

namespace rubatlas::rotor {

/// Shaft, then ring: x, y, x', y', rx, ry, rx', ry' [m, m per unit τ].
using ShaftAndRing = Eigen::Array<double, 8, 1>;

/// x, y, x', y', τ, u.
using ContactState = Eigen::Array<double, 6, 1>;
/// x, y, x', y', τ, u, rx, ry, rx', ry'.
using RingContactState = Eigen::Array<double, 10, 1>;
constexpr int kTime = 4;
constexpr int kBending = 5;
/// x, y, x', y', τ, and κ, φ of each contact.
constexpr int kFirstBend = 5;
constexpr int kMostBlades = 50;
using BendsState = Eigen::Array<double, Eigen::Dynamic, 1, 0, kFirstBend + 2 * kMostBlades, 1>;

/// What acts on a shaft whose ring is a body: `ShaftForcing` on the shaft, and the ring itself.
template <class ShaftForcing>
struct WithRingBody {
  static constexpr bool kPresent = true;
  ShaftForcing shaft;
  RingBody ring;
};

/// A ring without mass on a spring, which stands where blades push it, and in its place where none does.
struct FollowingRing {
  double stiffness;  ///< kr [N/m]
};
/// The same in such a ring.
template <class ShaftForcing>
struct WithFollowingRing {
  static constexpr bool kPresent = true;
  ShaftForcing shaft;
  FollowingRing ring;
};

template <class Forcing>
inline constexpr bool kRingFollows = false;
template <class ShaftForcing>
inline constexpr bool kRingFollows<WithFollowingRing<ShaftForcing>> = true;
template <class Forcing>
inline constexpr bool kRingMoves = kRingFollows<Forcing>;
template <class ShaftForcing>
inline constexpr bool kRingMoves<WithRingBody<ShaftForcing>> = true;

/// State between phases, and in contact.
template <class Forcing>
using BodiesOf = std::conditional_t<kRingMoves<Forcing>, ShaftAndRing, State>;
template <class Forcing>
using FullStateOf = std::conditional_t<kRingMoves<Forcing>, RingContactState, ContactState>;

/// A shaft, and where the ring moves that at rest in its place.
template <class Forcing>
BodiesOf<Forcing> ring_at_rest(const State& shaft) {
  BodiesOf<Forcing> bodies = BodiesOf<Forcing>::Zero();
  bodies.template head<4>() = shaft;
  return bodies;
}
/// What moves under a forcing, of the shaft and a ring that may move.
template <class Forcing>
BodiesOf<Forcing> bodies_of(const ShaftAndRing& all) {
  if constexpr (kRingMoves<Forcing>) {
    return all;
  } else {
    return all.head<4>();
  }
}
/// Shaft and ring of any machine: a ring that does not move is at rest in its place.
inline const ShaftAndRing& shaft_and_ring(const ShaftAndRing& bodies) {
  return bodies;
}
inline ShaftAndRing shaft_and_ring(const State& shaft) {
  ShaftAndRing bodies;
  bodies.head<4>() = shaft;
  bodies.tail<4>().setZero();
  return bodies;
}

/// A state of these bodies: one of others without the ring's part, or with a ring at rest.
template <class Bodies, class Others>
Bodies as(const Others& bodies) {
  if constexpr (std::is_same_v<Bodies, State>)
    return bodies.template head<4>();
  else if constexpr (std::is_same_v<Others, ShaftAndRing>)
    return bodies;
  else
    return (Bodies() << bodies, State::Zero()).finished();
}

/// The shaft's part.
inline const State& shaft(const State& bodies) {
  return bodies;
}
inline State shaft(const ShaftAndRing& bodies) {
  return bodies.head<4>();
}

/// The ring's part.
inline RingBody::State ring(const ShaftAndRing& bodies) {
  return bodies.tail<4>();
}
inline RingBody::State ring(const RingContactState& full) {
  return full.tail<4>();
}

/// Without time and bending parameter.
inline State bodies(const ContactState& full) {
  return full.head<4>();
}
inline State bodies(const BendsState& full) {
  return full.head<4>();
}
inline ShaftAndRing bodies(const RingContactState& full) {
  ShaftAndRing result;
  result << full.head<4>(), full.tail<4>();
  return result;
}

/// z − r and z' − r'.
inline const State& from_ring(const State& bodies) {
  return bodies;
}
inline State from_ring(const ShaftAndRing& bodies) {
  return bodies.head<4>() - bodies.tail<4>();
}
inline State from_ring(const ContactState& full) {
  return full.head<4>();
}
inline State from_ring(const BendsState& full) {
  return full.head<4>();
}
inline State from_ring(const RingContactState& full) {
  return full.head<4>() - full.tail<4>();
}

/// A state in contact.
inline ContactState full_state(const State& bodies, double time, double bending) {
  return {bodies[0], bodies[1], bodies[2], bodies[3], time, bending};
}
inline RingContactState full_state(const ShaftAndRing& bodies, double time, double bending) {
  RingContactState full;
  full << bodies.head<4>(), time, bending, bodies.tail<4>();
  return full;
}

/// Acceleration of one newton between shaft and ring, as a contact sees it [m/N].
template <class Forcing>
double closing_unit(const RotorConstants& rotor, [[maybe_unused]] const Forcing& forcing) {
  if constexpr (kRingMoves<Forcing>) return rotor.force_unit + forcing.ring.force_unit();
  return rotor.force_unit;
}

/// Accelerations of shaft and ring [m per unit τ²].
struct ShaftAndRingAcceleration {
  std::complex<double> shaft;
  std::complex<double> ring;
};
template <class Forcing>
using AccelerationOf =
    std::conditional_t<kRingMoves<Forcing>, ShaftAndRingAcceleration, std::complex<double>>;

/// Of all that moves, where the shaft has the acceleration `shaft` and blades push it by `force` [N], and the
/// ring by as much the other way.
template <class Forcing, class State>
AccelerationOf<Forcing> acceleration_of_all([[maybe_unused]] const State& full,
                                            [[maybe_unused]] const Forcing& forcing,
                                            const std::complex<double>& shaft,
                                            [[maybe_unused]] const std::complex<double>& force) {
  if constexpr (kRingFollows<Forcing>) {
    return ShaftAndRingAcceleration{shaft, 0.0};  // its velocity follows from the shaft's
  } else if constexpr (kRingMoves<Forcing>) {
    return ShaftAndRingAcceleration{shaft, forcing.ring.acceleration(ring(full), -force)};
  } else {
    return shaft;
  }
}

/// d/dτ of the bodies' state.
inline State rate_of(const ContactState& full, const std::complex<double>& acceleration) {
  return {full[2], full[3], acceleration.real(), acceleration.imag()};
}
inline State rate_of(const BendsState& full, const std::complex<double>& acceleration) {
  return {full[2], full[3], acceleration.real(), acceleration.imag()};
}
inline ShaftAndRing rate_of(const RingContactState& full, const ShaftAndRingAcceleration& acceleration) {
  ShaftAndRing rate;
  rate << full[2], full[3], acceleration.shaft.real(), acceleration.shaft.imag(), full[8], full[9],
      acceleration.ring.real(), acceleration.ring.imag();
  return rate;
}

}  // namespace rubatlas::rotor

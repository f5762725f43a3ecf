/// What moves: the shaft, and the ring where it is a body. States in flight and in contact, and what contacts
/// see of them.
///
/// A contact depends on where the shaft is as seen from the ring, z − r and z' − r'. In flight and between
/// phases a state has the shaft's four numbers and the ring's four behind them, which are zero where the ring
/// stands still; in contact, time and bending parameter stand between the two.
#pragma once

#include <Eigen/Core>
#include <complex>

#include "rotor/constants.hpp"
#include "rotor/ring_body.hpp"

namespace rubatlas::rotor {

/// Shaft, then ring: x, y, x', y', rx, ry, rx', ry' [m, m per unit τ].
using ShaftAndRing = Eigen::Array<double, 8, 1>;

/// x, y, x', y', τ, u, rx, ry, rx', ry'.
using ContactState = Eigen::Array<double, 10, 1>;
constexpr int kTime = 4;
/// Of the shaft alone: x, y, x', y', τ, and κ, φ of each contact.
constexpr int kFirstBend = 5;
constexpr int kMostBlades = 50;
using BendsState = Eigen::Array<double, Eigen::Dynamic, 1, 0, kFirstBend + 2 * kMostBlades, 1>;

/// A shaft, and a ring that stands still in its place.
inline ShaftAndRing shaft_and_ring(const State& shaft) {
  ShaftAndRing bodies;
  bodies.head<4>() = shaft;
  bodies.tail<4>().setZero();
  return bodies;
}

/// The shaft's part.
inline State shaft(const ShaftAndRing& bodies) {
  return bodies.head<4>();
}

/// The ring's part.
inline RingBody::State ring(const ShaftAndRing& bodies) {
  return bodies.tail<4>();
}
inline RingBody::State ring(const ContactState& full) {
  return full.tail<4>();
}
inline RingBody::State ring(const BendsState& /*full*/) {
  return RingBody::State::Zero();
}

/// Without time and what bends.
inline ShaftAndRing bodies(const BendsState& full) {
  return shaft_and_ring(full.head<4>());
}
inline ShaftAndRing bodies(const ContactState& full) {
  ShaftAndRing result;
  result << full.head<4>(), full.tail<4>();
  return result;
}

/// z − r and z' − r'.
inline State from_ring(const ShaftAndRing& bodies) {
  return bodies.head<4>() - bodies.tail<4>();
}
inline State from_ring(const BendsState& full) {
  return full.head<4>();
}
inline State from_ring(const ContactState& full) {
  return full.head<4>() - full.tail<4>();
}

/// A state in contact.
inline ContactState full_state(const ShaftAndRing& bodies, double time, double bending) {
  ContactState full;
  full << bodies.head<4>(), time, bending, bodies.tail<4>();
  return full;
}

/// Accelerations of shaft and ring [m per unit τ²].
struct Acceleration {
  std::complex<double> shaft;
  std::complex<double> ring;
};

/// d/dτ of the bodies' state.
inline ShaftAndRing rate_of(const BendsState& full, const Acceleration& acceleration) {
  return shaft_and_ring({full[2], full[3], acceleration.shaft.real(), acceleration.shaft.imag()});
}
inline ShaftAndRing rate_of(const ContactState& full, const Acceleration& acceleration) {
  ShaftAndRing rate;
  rate << full[2], full[3], acceleration.shaft.real(), acceleration.shaft.imag(), full[8], full[9],
      acceleration.ring.real(), acceleration.ring.imag();
  return rate;
}

}  // namespace rubatlas::rotor

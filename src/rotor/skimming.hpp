/// What keeps a tip on the ring that skims it (MODEL 4.9): the share λ of its force under which g'' vanishes,
///     g'' (free) + λ (g'' (full force) − g'' (free)) = 0
/// (Filippov, Differential Equations with Discontinuous Righthand Sides, 1988, §4: the convex combination of
/// the two sides; in λ also the share of time that hops spend in contact).
#pragma once

#include <complex>

#include "contact/tip.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::rotor {

/// g'' [m² per unit τ²] of a tip that bears nothing, where the others push the shaft by `others` [N].
template <class FullState>
double free_gap_curvature(const Machine& machine, const contact::Geometry& geometry,
                          const contact::BladeDirection& er, const contact::Pose& at, const FullState& state,
                          const std::complex<double>& others) {
  const State seen = from_ring(state);
  const Acceleration acceleration = machine.acceleration(state, others);
  return contact::gap_curvature(geometry, er, at, {seen[0], seen[1] + machine.constants.misalignment},
                                {seen[2], seen[3]}, acceleration.shaft - acceleration.ring,
                                machine.blades.angular_speed(state[kTime])) +
         2.0 * geometry.reach * machine.blades.angular_acceleration(state[kTime]) * at.tangential;
}

/// λ of a tip with this force.
template <class FullState>
double skimming_share(const Machine& machine, const contact::Geometry& geometry,
                      const contact::BladeDirection& er, const contact::Pose& at, const FullState& state,
                      const std::complex<double>& others, const contact::TipForce& force) {
  const double pushed = 2.0 * machine.closing_unit() *
                        ((at.radial + geometry.reach) * force.radial + at.tangential * force.tangential);
  return -free_gap_curvature(machine, geometry, er, at, state, others) / pushed;
}

/// A share of a force.
inline contact::TipForce share_of(contact::TipForce force, double share) {
  force.radial *= share;
  force.tangential *= share;
  force.normal *= share;
  force.root_strain *= share;
  return force;
}

/// The place and velocity of the shaft put back on g = 0, dg/dτ = 0, the shortest way. Acts on any state that
/// begins with (x, y, x', y').
template <class FullState>
void put_on_ring(const Machine& machine, const contact::Geometry& geometry, const contact::BladeDirection& er,
                 double angular_speed, FullState& state) {
  const auto at = [&] { return pose_of(machine.constants, geometry, er, from_ring(state)); };
  const State seen = from_ring(state);
  const double outward_x = seen[0] + geometry.reach * er.cosine;
  const double outward_y = seen[1] + machine.constants.misalignment + geometry.reach * er.sine;
  const double inverse = 0.5 / (outward_x * outward_x + outward_y * outward_y);
  const double gap = at().gap;
  state[0] -= gap * inverse * outward_x;
  state[1] -= gap * inverse * outward_y;
  const double rate = contact::gap_rate(geometry, at(), angular_speed);
  state[2] -= rate * inverse * outward_x;
  state[3] -= rate * inverse * outward_y;
}

}  // namespace rubatlas::rotor

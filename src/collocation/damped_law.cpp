#include "collocation/damped_law.hpp"

#include <array>
#include <utility>

namespace rubatlas::collocation {
DampedLaw::DampedLaw(Blades blades) : LawOfBlades(std::move(blades)) {
  ends_at_ring_ = false;
  for (int k = 0; k < count(); ++k) elastica_.push_back(&of(k).blade());
}

Blade DampedLaw::numbers(int blade) const {
  const contact::ElasticRingContact& straight = of(blade).straight();
  Blade numbers = ArcsOfAxialLoads::numbers(blade);
  numbers.ring_stiffness = straight.stiffness();
  numbers.ring_damping = straight.damping();
  return numbers;
}

/// A new contact stands on the ring, which yields by as much as its tip is deep.
std::optional<Touch> DampedLaw::in_equilibrium(const Touch& touch, const TipPlace& at) const {
  const contact::ElasticBladeOnDampedRing& law = of(touch.blade);
  Touch found = touch;
  if (touch.straight) {
    found.yielding = law.depth(at.pose);
    const BladeStart there = start(found, at);
    if (there.force.normal > 0.0 && there.start_cone_left > 0.0) return found;
    return std::nullopt;
  }
  if (touch.touches_down() && touch.yielding == 0.0) found.yielding = law.depth(at.pose);
  contact::Pose there = at.pose;
  if (touch.touches_down())
    there.gap = 0.0;
  else
    there.gap -= contact::widening(found.yielding, law.geometry().ring_radius);
  if (touch.touches_down() && starts_unloaded(touch.blade, touch.slip, there)) return found;
  contact::TipForce force{};
  if (!law.blade().respond(there, touch.slip, at.speed, found.bending, force)) return std::nullopt;
  found.just_bent = touch.touches_down();
  return found;
}

double DampedLaw::ring_opens(const Touch& touch, const TipPlace& at) const {
  const contact::ElasticBladeOnDampedRing& law = of(touch.blade);
  return 2.0 * (law.geometry().ring_radius + touch.yielding) *
         law.yielding_rate(force(touch, at).normal, touch.yielding);
}

BladeStart DampedLaw::start(const Touch& touch, const TipPlace& at) const {
  if (touch.straight) {
    const contact::ElasticBladeOnDampedRing& law = of(touch.blade);
    const contact::TipForce there = force(touch, at);
    BladeStart start = starts(touch, there, there.normal / law.straight().stiffness());
    start.start_cone_left = law.bending_load(at.pose, touch.slip, at.speed) - there.normal;
    return start;
  }
  BladeStart start = ArcsOfAxialLoads::start(touch, at);
  start.ring_opens = ring_opens(touch, at);
  return start;
}

Law::Tangent DampedLaw::tangent(const Touch& touch, const TipPlace& at,
                                const std::complex<double>& acceleration) const {
  // The ring follows the load of a blade that has just bent in a moment, often within 1e-6: how p changes
  // at first says nothing of the arc. Then it changes as slowly as the load of the ring.
  if (touch.straight || touch.just_bent) return {1.0, 0.0, 0.0};
  Tangent along = ArcsOfAxialLoads::tangent(touch, at, acceleration);
  along.argument -= ring_opens(touch, at);
  return along;
}

contact::TipForce DampedLaw::force(const Touch& touch, const TipPlace& at) const {
  return touch.straight ? of(touch.blade).straight().force(at.pose, touch.slip, at.speed)
                        : ArcsOfAxialLoads::force(touch, at);
}

bool DampedLaw::solve(const Machine& machine, const Closeness& closeness, Interval& interval) const {
  if (!ArcsOfAxialLoads::solve(machine, closeness, interval)) return false;
  for (TipInTime& tip : interval.tips) {
    if (tip.straight) find_bending_left(machine, interval, tip);
  }
  return true;
}

/// At the nodes the load that would bend a straight blade, less its own.
void DampedLaw::find_bending_left(const Machine& machine, const Interval& interval, TipInTime& tip) const {
  const contact::ElasticBladeOnDampedRing& law = of(tip.number);
  const std::array<double, 2>& offset = tip.offset;
  const Body& shaft = interval.shaft;
  const Body& ring = interval.ring;
  for (std::size_t i = 0; i < kNodes; ++i) {
    const contact::BladeDirection er{interval.blade_x[i] * offset[0] - interval.blade_y[i] * offset[1],
                                     interval.blade_y[i] * offset[0] + interval.blade_x[i] * offset[1]};
    const contact::Pose at = contact::pose(law.geometry(), er, shaft.x[i] - ring.x[i],
                                           shaft.y[i] - ring.y[i] + machine.misalignment,
                                           shaft.vx[i] - ring.vx[i], shaft.vy[i] - ring.vy[i]);
    tip.cone_left[i] = law.bending_load(at, tip.slip, interval.angular_speed[i]) - tip.normal_force[i];
  }
}

bool DampedLaw::open(const TipPlace& at, Touch& touch) const {
  const auto& blade = of(touch.blade);
  const double load = blade.straight().force(at.pose, touch.slip, at.speed).normal;
  touch.straight = load < blade.bending_load(at.pose, touch.slip, at.speed);
  return true;
}

bool DampedLaw::straightens(const TipPlace& at, Touch& touch) const {
  const contact::TipForce force = of(touch.blade).straight().force(at.pose, touch.slip, at.speed);
  if (touch.straight || !(force.normal > 0.0)) return false;
  touch.straight = true;
  touch.bending = 0.0;
  return true;
}

}  // namespace rubatlas::collocation

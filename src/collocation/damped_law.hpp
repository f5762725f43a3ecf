/// Elastic blades under an axial load, with Coulomb friction, on a ring with a damper under each tip (MODEL
/// 7.16). Under a blade that stands straight only the ring yields, as under a rigid one: its
/// p does not change, and an arc that it leads is a stretch of time.
#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <utility>

#include "collocation/axial_law.hpp"
#include "contact/damped_ring.hpp"

namespace rubatlas::collocation {

class DampedLaw final : public LawOfBlades<DampedLaw, contact::ElasticBladeOnDampedRing, ArcsOfAxialLoads> {
 public:
  explicit DampedLaw(Blades blades) : LawOfBlades(std::move(blades)) {
    ends_at_ring_ = false;
    for (int k = 0; k < count(); ++k) elastica_.push_back(&of(k));
  }

  [[nodiscard]] Blade numbers(int blade) const override {
    const contact::ElasticRingContact& straight = of(blade).straight();
    Blade numbers = ArcsOfAxialLoads::numbers(blade);
    numbers.ring_stiffness = straight.stiffness();
    numbers.ring_damping = straight.damping();
    return numbers;
  }
  /// A new contact stands on the ring, which yields by as much as its tip is deep.
  [[nodiscard]] std::optional<Touch> in_equilibrium(const Touch& touch, const TipPlace& at) const override {
    const contact::ElasticBladeOnDampedRing& law = of(touch.blade);
    Touch found = touch;
    if (touch.straight) {
      found.yielding = law.depth(at.pose);
      const BladeStart there = start(found, at);
      if (there.at_start.normal > 0.0 && there.start_cone_left > 0.0) return found;
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
    if (!law.respond(there, touch.slip, at.speed, found.bending, force)) return std::nullopt;
    found.just_bent = touch.touches_down();
    return found;
  }
  [[nodiscard]] BladeStart start(const Touch& touch, const TipPlace& at) const override {
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
  [[nodiscard]] Tangent tangent(const Touch& touch, const TipPlace& at,
                                const std::complex<double>& acceleration) const override {
    // The ring follows the load of a blade that has just bent in a moment, often within 1e-6: how p changes
    // at first says nothing of the arc. Then it changes as slowly as the load of the ring.
    if (touch.straight || touch.just_bent) return {1.0, 0.0, 0.0};
    Tangent along = ArcsOfAxialLoads::tangent(touch, at, acceleration);
    along.argument -= ring_opens(touch, at);
    return along;
  }
  [[nodiscard]] bool solve(const Machine& machine, const Closeness& closeness,
                           Interval& interval) const override {
    if (!ArcsOfAxialLoads::solve(machine, closeness, interval)) return false;
    for (TipInTime& tip : interval.tips) {
      if (tip.straight) find_bending_left(machine, interval, tip);
    }
    return true;
  }
  [[nodiscard]] contact::TipForce force(const Touch& touch, const TipPlace& at) const override {
    return touch.straight ? of(touch.blade).straight().force(at.pose, touch.slip, at.speed)
                          : ArcsOfAxialLoads::force(touch, at);
  }

  /// On the receding side a blade stands straight while the ring's load is too small to bend it.
  [[nodiscard]] bool open(const TipPlace& at, Touch& touch) const override {
    const auto& blade = of(touch.blade);
    const double load = blade.straight().force(at.pose, touch.slip, at.speed).normal;
    touch.straight = load < blade.bending_load(at.pose, touch.slip, at.speed);
    return true;
  }
  /// A blade that has unbent to the ring's circle stays in contact where the ring pushes it.
  [[nodiscard]] bool straightens(const TipPlace& at, Touch& touch) const override {
    const contact::TipForce force = of(touch.blade).straight().force(at.pose, touch.slip, at.speed);
    if (touch.straight || !(force.normal > 0.0)) return false;
    touch.straight = true;
    touch.bending = 0.0;
    return true;
  }

 private:
  /// At the nodes the load that would bend a straight blade, less its own.
  void find_bending_left(const Machine& machine, const Interval& interval, TipInTime& tip) const {
    const contact::ElasticBladeOnDampedRing& law = of(tip.number);
    const Body& shaft = interval.shaft;
    const Body& ring = interval.ring;
    for (std::size_t i = 0; i < kNodes; ++i) {
      const contact::Pose at = contact::pose(
          law.geometry(), tip.direction(interval.blade_x[i], interval.blade_y[i]), shaft.x[i] - ring.x[i],
          shaft.y[i] - ring.y[i] + machine.misalignment, shaft.vx[i] - ring.vx[i], shaft.vy[i] - ring.vy[i]);
      tip.cone_left[i] = law.bending_load(at, tip.slip, interval.angular_speed[i]) - tip.normal_force[i];
    }
  }
  [[nodiscard]] double ring_opens(const Touch& touch, const TipPlace& at) const {
    const contact::ElasticBladeOnDampedRing& law = of(touch.blade);
    return 2.0 * (law.geometry().ring_radius + touch.yielding) *
           law.yielding_rate(force(touch, at).normal, touch.yielding);
  }
};

}  // namespace rubatlas::collocation

/// Rigid blades on an elastic ring, with any friction law (MODEL 4.7): it yields under each tip, with a
/// damper or without, or has no mass and stands where all blades push it. The force is a function of the
/// tip's place and velocity: p is 1 throughout, and an arc is a stretch of time.
#pragma once

#include <algorithm>
#include <complex>
#include <optional>
#include <span>
#include <utility>

#include "collocation/law.hpp"
#include "contact/elastic_ring_contact.hpp"
#include "contact/sticking.hpp"
#include "rotor/bodies.hpp"
#include "rotor/machine.hpp"
#include "rotor/ring_balance.hpp"

namespace rubatlas::collocation {

class RigidLaw final : public LawOfBlades<RigidLaw, contact::ElasticRingContact> {
 public:
  explicit RigidLaw(Blades blades) : LawOfBlades(std::move(blades)) {
    is_rigid_ = true;
    ends_at_ring_ = of(0).damping() == 0.0;
  }

  void take_machine(const rotor::Machine& machine) override { machine_ = &machine; }
  [[nodiscard]] Blade numbers(int blade) const override {
    const auto& law = of(blade);
    return {.reach = law.geometry().reach,
            .closing = law.geometry().closing(),
            .ring_stiffness = law.stiffness(),
            .ring_damping = law.damping()};
  }
  /// With a ring without mass v jumps, and a tip that would slip back is beyond the model.
  [[nodiscard]] bool may_slip_back() const override {
    return has_slip_state() && !friction_.sticks && machine_->following_ring() == nullptr;
  }
  [[nodiscard]] bool starts_unloaded(int /*blade*/, double /*slip*/,
                                     const contact::Pose& /*at*/) const override {
    return ends_at_ring();
  }
  /// A tip that moves inwards faster than a ring with dampers pushes it lifts off at once.
  [[nodiscard]] std::optional<Touch> in_equilibrium(const Touch& touch, const TipPlace& at) const override {
    if (is_free_at_once(touch, at)) return std::nullopt;
    return touch;
  }
  Bending lead(const Touch& /*touch*/) override { return {kArgument}; }
  [[nodiscard]] BladeStart start(const Touch& touch, const TipPlace& at) const override {
    const contact::TipForce there = force(touch, at);
    const double load = there.normal * machine_->constants.force_unit;
    const double largest = contact::largest_at_rest(friction_);
    BladeStart start = starts(touch, there, there.normal / of(touch.blade).stiffness());
    start.start_cone_left = (largest * largest - touch.holding * touch.holding) * load * load;
    return start;
  }
  void set_course(const Touch& /*touch*/, const TipPlace& /*at*/, BladeStart& start) const override {
    start.square = {start.start_gap_measure};
  }
  [[nodiscard]] bool solve(const Machine& machine, const Closeness& closeness,
                           Interval& interval) const override {
    return solver_.solve_rigid(machine, friction_, closeness, interval) && resolves_friction(interval);
  }
  [[nodiscard]] Touch touch(const TipStart& tip, const Bending& /*bending*/) const override {
    return {tip.number, tip.slip, 0.0};
  }
  [[nodiscard]] contact::TipForce force(const Touch& touch, const TipPlace& at) const override {
    contact::TipForce result = of(touch.blade).force(at.pose, touch.slip, at.speed);
    if (touch.slip == 0.0 && touch.holding != 0.0) {
      const std::complex<double> tangent = contact::tangent(geometry(touch.blade), at.pose);
      const double friction = touch.holding * result.normal;
      result.radial -= friction * tangent.real();
      result.tangential -= friction * tangent.imag();
    }
    return result;
  }
  bool place_ring(const rotor::Machine& machine, std::span<const Touch> touching,
                  rotor::ContactState& state) const override {
    return rotor::RingBalance(machine, *this, touching).place(state);
  }

  bool respond(const TipPlace& at, Touch& touch, contact::TipForce& force) const override {
    force = this->force(touch, at);
    return true;
  }
  [[nodiscard]] bool knows_rest() const override { return true; }

 private:
  /// Whether the nodes see how friction passes through zero slip, within v0: else what it does there could
  /// hide between two of them.
  [[nodiscard]] bool resolves_friction(const Interval& interval) const {
    if (has_slip_state()) return true;
    const double width = friction_.regularising_velocity;
    return std::ranges::all_of(interval.tips, [width](const TipInTime& tip) {
      constexpr double kSteep = 10.0;  // v/v0 up to which tanh changes
      constexpr double kSeen = 3.0;
      const auto [low, high] = std::ranges::minmax(at_places(tip.at_start.slip_velocity, tip.slip_velocity));
      return low > kSteep * width || high < -kSteep * width || high - low < kSeen * width;
    });
  }

  static constexpr double kArgument = 1.0;  ///< p: not 0, from where a blade would begin to bend

  const rotor::Machine* machine_ = nullptr;
};

}  // namespace rubatlas::collocation

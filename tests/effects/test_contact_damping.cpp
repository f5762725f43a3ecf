// A damper beside the ring's spring under each tip: limits, energy, and a force that never pulls.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "../settings/scene_error_text.hpp"
#include "../support/hybrid_motion.hpp"
#include "contact/damped_ring.hpp"
#include "effect_scene.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;
using nlohmann::json;

constexpr rotor::RotorConstants kDampedRotor{0.62, 0.05, 0.01001, 0.01, 0.01};
constexpr contact::Geometry kDampedGeometry{0.1, 0.11};
constexpr double kRingStiffness = 1e4;  // N/m
constexpr double kRingDamping = 2e2;    // N per (m per unit τ)
constexpr int kDampedBlades = 3;

/// Where the tip of blade k is, how deep in the undeformed ring, and how fast that changes.
struct DampedTip {
  double depth;
  double rate;
  double outward_by_turning;  ///< n·(Ω ez × (rh+L) er) [m per unit τ]
};
DampedTip damped_tip_of(int blade, double time, const rotor::State& state) {
  const rotor::BladeSet blades(kDampedBlades, kDampedRotor.speed_ratio);
  const auto er = blades.direction(blade, blades.first(time));
  const contact::Pose at = rotor::pose_of(kDampedRotor, kDampedGeometry, er, state);
  const double distance = std::hypot(at.radial + kDampedGeometry.reach, at.tangential);
  const double turning = kDampedRotor.speed_ratio * kDampedGeometry.reach * at.tangential / distance;
  return {distance - kDampedGeometry.ring_radius,
          0.5 * contact::gap_rate(kDampedGeometry, at, kDampedRotor.speed_ratio) / distance, turning};
}

/// Integrals over contacts with 10 Gauss points a piece, and the force at each lift-off.
class DamperWatch final : public modes::MotionListener {
 public:
  void piece(trajectory::MotionPiece& piece) override {
    constexpr std::array kNodes{0.1488743389816312, 0.4333953941292472, 0.6794095682990244,
                                0.8650633666889845, 0.9739065285171717};
    constexpr std::array kWeights{0.2955242247147529, 0.2692667193099963, 0.2190863625159820,
                                  0.1494513491505806, 0.0666713443086881};
    const double half = 0.5 * (piece.end() - piece.begin());
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
      for (const double node : {-kNodes[i], kNodes[i]}) {
        const double time = piece.begin() + half * (1.0 + node);
        const rotor::State state = rotor::as_state(piece.state(time));
        lost_to_shaft +=
            kWeights[i] * half * 2.0 * kDampedRotor.damping_ratio * state.tail<2>().square().sum();
        for (std::size_t k = 0; k < piece.contact_count(); ++k) {
          const DampedTip tip = damped_tip_of(piece.blade(k), time, state);
          const double force = piece.normal_force(k, time);
          least_force = std::min(least_force, force);
          driven += kWeights[i] * half * kDampedRotor.force_unit * force * tip.outward_by_turning;
          lost_to_ring += kWeights[i] * half * kDampedRotor.force_unit * kRingDamping * tip.rate * tip.rate;
        }
      }
    }
  }
  void event(const modes::Event& event) override {
    if (event.kind == modes::Guard::touch_down) ++touchdowns;
    if (event.kind != modes::Guard::lift_off) return;
    const DampedTip tip = damped_tip_of(event.blade, event.time, event.state);
    depths.push_back(tip.depth);
    // The spring of a ring that creeps back gives its energy to its damper.
    lost_to_ring += 0.5 * kDampedRotor.force_unit * kRingStiffness * tip.depth * tip.depth;
    forces.push_back(kRingStiffness * tip.depth + kRingDamping * tip.rate);
  }
  double least_force = 0.0;
  double lost_to_shaft = 0.0;
  double lost_to_ring = 0.0;
  double driven = 0.0;
  int touchdowns = 0;
  std::vector<double> depths;
  std::vector<double> forces;
};

double damped_energy(double time, const rotor::State& state) {
  double sum = 0.5 * state.square().sum();
  for (int k = 0; k < kDampedBlades; ++k) {
    const double depth = std::max(0.0, damped_tip_of(k, time, state).depth);
    sum += 0.5 * kDampedRotor.force_unit * kRingStiffness * depth * depth;
  }
  return sum;
}

/// Three revolutions without friction.
struct FollowedWithDampers {
  DamperWatch watch;
  double energy_gained;
};
FollowedWithDampers follow_with_dampers() {
  const contact::ElasticRingContact law(kDampedGeometry, kRingStiffness, {0.0}, kRingDamping);
  const auto motion = hybrid_motion(kDampedRotor, rotor::BladeSet(kDampedBlades, kDampedRotor.speed_ratio),
                                    law, kNoForcing, {1e-12 * kDampedRotor.length_scale, 0.5});
  FollowedWithDampers followed{};
  EXPECT_EQ(start(*motion, rotor::State{0.0, 0.0, 0.004, 0.002}), PointStatus::done);
  const double before = damped_energy(0.0, rotor::shaft(motion->state()));
  for (int revolution = 0; revolution < 3; ++revolution)
    EXPECT_EQ(revolve(*motion, followed.watch), PointStatus::done);
  followed.energy_gained = damped_energy(0.0, rotor::shaft(motion->state())) - before;
  return followed;
}

TEST(ContactDamping, TheTipLiftsOffWhereTheForceVanishesInsideTheRingAndTheRingNeverPulls) {
  const DamperWatch watch = follow_with_dampers().watch;
  ASSERT_GT(watch.touchdowns, 3);
  ASSERT_GT(watch.forces.size(), 3U);
  for (const double force : watch.forces)
    EXPECT_NEAR(force, 0.0, 1e-9 * kRingStiffness * kDampedRotor.length_scale);
  EXPECT_GT(*std::ranges::min_element(watch.depths), 0.0);
  EXPECT_GE(watch.least_force, -1e-9 * kRingStiffness * kDampedRotor.length_scale);
}

/// One blade on a soft ring with a strong damper, pressed into it by a constant load along x, that has lifted
/// off inside: it turns outwards 0.4 later. Its revolution has still `left` to go [τ].
struct LiftedOffInside {
  static constexpr double kSpeed = 0.05;
  static constexpr rotor::RotorConstants kRotor{kSpeed, 0.05, 0.0, 0.01, 0.01};
  const rotor::Harmonic load{0.02, 0.0, 0.0, kRotor.damping_ratio};
  const contact::ElasticRingContact law{kDampedGeometry, 1e2, contact::Friction::coulomb(0.1), 1e3};

  [[nodiscard]] std::unique_ptr<motion::Motion> motion() const {
    return hybrid_motion(machine_of(kRotor, rotor::BladeSet(1, kSpeed), load), law, {1e-12, 0.5}, true);
  }
  static motion::PointStart start(double left) {
    motion::PointStart result{{0.013, 0.0, -0.003, 0.0}};
    result.time = kRotor.period() - left;
    return result;
  }
};
/// The events of a blade, and how fast its tip moves outwards there.
class FirstTouchdown final : public modes::MotionListener {
 public:
  void event(const modes::Event& event) override {
    events.push_back(event);
    if (event.kind != modes::Guard::touch_down || touched) return;
    const rotor::BladeSet blades(1, LiftedOffInside::kSpeed);
    const contact::Pose at = rotor::pose_of(LiftedOffInside::kRotor, kDampedGeometry,
                                            blades.direction(0, blades.first(event.time)), event.state);
    touched = {at.gap, contact::gap_rate(kDampedGeometry, at, LiftedOffInside::kSpeed)};
  }
  struct Touched {
    double gap, rate;
  };
  std::optional<Touched> touched;
  std::vector<modes::Event> events;
};

TEST(ContactDamping, TheTipThatIsFreeInsideTouchesTheRingWhereItTurnsOutwards) {
  const LiftedOffInside rotor;
  const auto motion = rotor.motion();
  FirstTouchdown witness;
  ASSERT_EQ(motion->start(LiftedOffInside::start(1.0)), ending::StatusDetail::none);
  ASSERT_EQ(revolve(*motion, witness), PointStatus::done);
  ASSERT_TRUE(witness.touched.has_value());
  EXPECT_GT(witness.touched->gap, 1e-4);
  EXPECT_LT(std::abs(witness.touched->rate), 1e-15);
}

TEST(ContactDamping, TheTipThatIsFreeInsideStaysFreeWhereTheMachineChangesBetweenRevolutions) {
  const LiftedOffInside rotor;
  for (const double left : {0.2, 0.37}) {  // where the ring would push it, or would have to pull
    std::vector<modes::Event> goes_on;
    for (const bool changes : {false, true}) {
      auto motion = rotor.motion();
      FirstTouchdown before;
      FirstTouchdown after;
      ASSERT_EQ(motion->start(LiftedOffInside::start(left)), ending::StatusDetail::none);
      ASSERT_EQ(revolve(*motion, before), PointStatus::done);
      if (changes) {
        auto next = rotor.motion();
        ASSERT_EQ(next->take_over(*motion), ending::StatusDetail::none);
        motion = std::move(next);
      }
      ASSERT_EQ(revolve(*motion, after), PointStatus::done);
      if (!changes) {
        goes_on = after.events;
        continue;
      }
      ASSERT_EQ(after.events.size(), goes_on.size());
      for (std::size_t i = 0; i < goes_on.size(); ++i) {
        EXPECT_EQ(after.events[i].kind, goes_on[i].kind);
        EXPECT_NEAR(after.events[i].time, goes_on[i].time, 1e-9);
      }
    }
  }
}

TEST(ContactDamping, EnergyThatNoDriveHasGivenFallsByWhatTheDampersTake) {
  const auto [watch, gained] = follow_with_dampers();
  EXPECT_GT(watch.lost_to_ring, 1e-9);
  const double balance = gained - watch.driven + watch.lost_to_shaft + watch.lost_to_ring;
  EXPECT_LE(std::abs(balance), 1e-6 * watch.lost_to_ring);
}

/// The default rotor at a speed, with more said of it.
json damped_scene_with(const json& more, double speed_ratio) {
  json scene = {{"grid", {{"speed_ratio", speed_ratio}}},
                {"protocol", {{"transient_revolutions", 0}, {"sampled_revolutions", 2}}},
                {"accuracy", {{"tolerance", 1e-11}}},
                {"observables", {"poincare"}}};
  scene.update(more);
  return scene;
}
motion::SectionState damped_end_of(const json& scene) {
  const auto outcome = run(parsed(scene));
  EXPECT_EQ(outcome.status, PointStatus::done) << scene.dump();
  return outcome.final_state;
}

TEST(ContactDamping, OfRigidBladesGoesOverToTheSpringAloneInProportion) {
  for (const double speed : {0.36, 0.62}) {
    const json plain = damped_scene_with({{"contact", {{"law", "elastic_ring"}}}}, speed);
    const auto limit = damped_end_of(plain);
    std::optional<double> before;
    for (const double damping : {1e-2, 1e-3, 1e-4}) {
      json damped = plain;
      damped["contact_damping"] = {{"damping", damping}};
      const double apart = largest_difference(damped_end_of(damped), limit);
      if (before) {
        EXPECT_NEAR(*before / apart, 10.0, 0.5) << speed;
      }
      before = apart;
    }
  }
}

TEST(ContactDamping, OfElasticBladesGoesOverToARigidRingAsTheDamperStiffens) {
  for (const double speed : {0.36, 0.62}) {
    const auto limit = damped_end_of(damped_scene_with(json::object(), speed));
    std::optional<double> before;
    for (const double damping : {1e5, 1e6, 1e7}) {
      const auto end = damped_end_of(damped_scene_with(
          {{"yielding_ring", {{"compliance", 1e-4}}}, {"contact_damping", {{"damping", damping}}}}, speed));
      const double apart = largest_difference(end, limit);
      if (before) {
        EXPECT_NEAR(*before / apart, 10.0, 0.5) << speed;
      }
      before = apart;
    }
  }
}

TEST(ContactDamping, OfElasticBladesGoesOverToTheSpringAloneAsTheDamperWeakens) {
  const json ring = {{"yielding_ring", {{"compliance", 1e-4}}}};
  for (const double speed : {0.36, 0.62}) {
    const auto limit = damped_end_of(damped_scene_with(ring, speed));
    std::optional<double> before;
    for (const double damping : {10.0, 3.0, 1.0}) {
      json damped = ring;
      damped["contact_damping"] = {{"damping", damping}};
      const double apart = largest_difference(damped_end_of(damped_scene_with(damped, speed)), limit);
      if (before) {
        EXPECT_LT(apart, 0.6 * *before) << speed;
      }
      before = apart;
    }
  }
}

TEST(ContactDamping, OfColumnsIsTheLimitOfVanishingFrictionInProportion) {
  // Straight, a column pushes the ring like a rigid blade up to its Euler load, where it bends.
  const auto with_friction = [](double friction, double speed) {
    json scene = damped_scene_with(
        {{"yielding_ring", {{"compliance", 1e-5}}}, {"contact_damping", {{"damping", 10.0}}}}, speed);
    scene["contact"]["friction"] = friction;
    scene["initial"] = {{"vy", -0.05}};  // it bends
    return damped_end_of(scene);
  };
  for (const double speed : {0.36, 0.62}) {
    const auto limit = with_friction(0.0, speed);
    const double before = largest_difference(with_friction(1e-3, speed), limit);
    const double after = largest_difference(with_friction(1e-4, speed), limit);
    EXPECT_GT(after, 0.0);
    EXPECT_NEAR(before / after, 10.0, 0.5) << speed;
  }
}

TEST(ContactDamping, IsRefusedWhereNothingYieldsUnderATip) {
  const auto refusal_with = [](const json& more) {
    return settings::refusal(damped_scene_with(more, 0.5).dump());
  };
  const json damper = {{"contact_damping", {{"damping", 1.0}}}};
  EXPECT_EQ(refusal_with(damper).rfind("/contact_damping: ", 0), 0U);
  json beside = damper;
  beside["yielding_ring"] = json::object();
  EXPECT_EQ(refusal_with(beside), "accepted");
  beside.erase("yielding_ring");
  beside["contact"] = {{"law", "elastic_ring"}};
  EXPECT_EQ(refusal_with(beside), "accepted");
  beside["stick"] = json::object();
  EXPECT_NE(refusal_with(beside).find("/contact_damping"), std::string::npos);
}

}  // namespace
}  // namespace rubatlas::test

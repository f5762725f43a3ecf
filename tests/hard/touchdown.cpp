/// The three touch-downs and lift-offs at which the elastica's force is not smooth in time (MODEL 3.3, 4.2).
#include <gtest/gtest.h>

#include <cmath>

#include "recorded_motion.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;
using modes::Guard;
using rotor::State;

/// One blade in a ring around the shaft's own centre, lengths without rounding: a tip placed on the ring is
/// on it.
HardRotor one_blade() {
  HardRotor rotor;
  rotor.blades = 1;
  rotor.misalignment = 0.0;
  rotor.ring_radius = 0.140625;
  rotor.length = 0.125;
  return rotor;
}

TEST(Touchdown, HeadOnTheForceStartsLikeTheRootOfTime) {
  // ct = 0 and g = 0 at τ = 0, moving straight at the ring: with Δ = μ F L³/3EI and δ = 3/5 Δ²/L the contact
  // equation is g = Δ² (6/5 R/L − 1) to leading order, and g = 2 R v τ: the force is not Lipschitz in time.
  const HardRotor rotor = one_blade();
  const double velocity = 0.02;
  const double length = rotor.length;
  const double unit = 3.0 * rotor.bending_stiffness / (rotor.friction * length * length * length);
  const double steepness = 1.2 * rotor.ring_radius / length - 1.0;
  int compared = 0;
  const auto motion = follow(
      rotor, rotor.elastica(), kNoForcing, {rotor.clearance(), 0.0, velocity, 0.0}, 1,
      [&](trajectory::MotionPiece& piece) {
        if (piece.contact_count() == 0 || piece.begin() > 0.0) return;
        for (const double time : {1e-14, 1e-12, 1e-10}) {
          if (time >= piece.end()) continue;
          const double gap = 2.0 * rotor.ring_radius * velocity * time;
          EXPECT_NEAR(piece.normal_force(0, time) / (unit * std::sqrt(gap / steepness)), 1.0, 2e-2) << time;
          ++compared;
        }
      },
      false);
  EXPECT_EQ(motion.status, PointStatus::done);
  EXPECT_GE(compared, 3);
}

TEST(Touchdown, OnTheRecedingSideTheForceIsFiniteAtOnce) {
  // MODEL 4.2: 1 mm beyond top dead centre, 0.42 of the Euler load.
  HardRotor rotor;
  rotor.blades = 1;
  rotor.misalignment = 0.0;
  const double across = -1e-3;
  const double along =
      std::sqrt(rotor.ring_radius * rotor.ring_radius - across * across) - rotor.length - 1e-9;
  double first_force = 0.0;
  double before = -1.0;
  const auto motion = follow(rotor, rotor.elastica(), kNoForcing, {along, across, 0.02, 0.0}, 1,
                             [&](trajectory::MotionPiece& piece) {
                               if (piece.contact_count() == 0 && before < 0.0) before = piece.end();
                               if (piece.contact_count() == 1 && first_force == 0.0)
                                 first_force = piece.normal_force(0, piece.begin());
                             });
  ASSERT_EQ(motion.status, PointStatus::done);
  const auto touchdowns = motion.of_kind(Guard::touch_down);
  ASSERT_FALSE(touchdowns.empty());
  EXPECT_EQ(touchdowns[0].time, before) << "flight up to the touch-down";
  const contact::Pose at = pose_at(rotor, 0, touchdowns[0].time, touchdowns[0].state);
  EXPECT_LT(touchdowns[0].slip * at.tangential, 0.0);
  const auto law = rotor.elastica();
  const auto root = law.solve(at, touchdowns[0].slip);
  ASSERT_TRUE(root.has_value());
  EXPECT_NEAR(first_force, law.constraint(at, touchdowns[0].slip, *root, rotor.speed_ratio).force.normal,
              1e-9 * first_force);
  EXPECT_NEAR(first_force / rotor.euler_load(), 0.42, 0.01);
}

TEST(Touchdown, LiftOffGoesThroughTheFoldWithoutAJump) {
  // The shaft's tangential velocity sets where the blade leaves: before top dead centre, where the load has
  // come down to zero, or behind it, where the load drops from a finite value. In between lies the fold,
  // where both rates of the contact equation vanish at lift-off; it is approached to the last bits by
  // bisection.
  HardRotor rotor = one_blade();
  rotor.damping_ratio = 0.05;
  const auto law = rotor.elastica();
  struct Leaving {
    double time, across, gap;
  };
  const auto leaving = [&](double velocity) {
    const auto motion = follow(rotor, law, kNoForcing, {rotor.clearance(), 1e-3, 0.02, velocity}, 1,
                               [](trajectory::MotionPiece&) {});
    EXPECT_EQ(motion.status, PointStatus::done) << velocity;
    const auto liftoffs = motion.of_kind(Guard::lift_off);
    EXPECT_FALSE(liftoffs.empty()) << velocity;
    if (liftoffs.empty()) return Leaving{};
    const contact::Pose at = pose_at(rotor, 0, liftoffs[0].time, liftoffs[0].state);
    EXPECT_EQ(liftoffs[0].slip, 1.0) << velocity;
    return Leaving{liftoffs[0].time, at.tangential, at.gap};
  };
  double receding = -0.01;
  double approaching = 0.01;
  ASSERT_LT(leaving(receding).across, 0.0);
  ASSERT_GT(leaving(approaching).across, 0.0);
  double last_time = leaving(receding).time;
  for (int i = 0; i < 60; ++i) {
    const double velocity = 0.5 * (receding + approaching);
    const Leaving at = leaving(velocity);
    EXPECT_NEAR(at.gap, 0.0, 1e-16) << velocity;
    // The instant depends on the velocity with a slope of about one (both in units of the sweep): no jump.
    EXPECT_NEAR(at.time, last_time, 1.5 * (approaching - receding) + 1e-9) << velocity;
    (at.across > 0.0 ? approaching : receding) = velocity;
    last_time = at.time;
  }
  EXPECT_NEAR(leaving(approaching).across, 0.0, 1e-12);
}

}  // namespace
}  // namespace rubatlas::test

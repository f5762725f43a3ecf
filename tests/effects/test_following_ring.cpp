// The ring without mass: it stands where the springs under all tips in contact balance its own, at every
// instant.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "../support/hybrid_motion.hpp"
#include "../support/section_differences.hpp"
#include "contact/elastic_ring_contact.hpp"
#include "effect_scene.hpp"

namespace rubatlas::test {
namespace {

constexpr contact::Geometry kFollowedGeometry{0.1, 0.11};

std::unique_ptr<motion::Motion> rigid_blades_in(const rotor::RotorConstants& rotor, int blades,
                                                const contact::ElasticRingContact& law,
                                                const rotor::Ring& ring, double tolerance = 1e-15) {
  return hybrid_motion(machine_of(rotor, rotor::BladeSet(blades, rotor.speed_ratio), kNoForcing, ring), law,
                       {tolerance, 0.5});
}

rotor::RotorConstants rotor_in_following_ring(double damping, double misalignment) {
  return {0.62, damping, misalignment, 0.01, 0.01};  // m = 1 kg, ωn = 10/s
}

/// Most blades in contact at once.
class CountOfBlades final : public modes::MotionListener {
 public:
  void piece(trajectory::MotionPiece& piece) override { most = std::max(most, piece.contact_count()); }
  std::size_t most = 0;
};

TEST(FollowingRing, UnderOneBladeWithoutFrictionIsASpringInSeriesWithThatUnderTheTip) {
  const auto after = [](double tip, const rotor::Ring& ring) {
    const rotor::RotorConstants rotor = rotor_in_following_ring(0.1, 0.01001);
    const auto motion = rigid_blades_in(rotor, 1, {kFollowedGeometry, tip, {0.0}}, ring);
    EXPECT_EQ(start(*motion, rotor::State(rotor::State::Zero())), ending::PointStatus::done);
    modes::MotionListener nobody;
    for (int revolution = 0; revolution < 5; ++revolution) {
      EXPECT_EQ(revolve(*motion, nobody), ending::PointStatus::done);
    }
    EXPECT_EQ(motion->work().touchdowns, 5U);
    return rotor::shaft(motion->state());
  };
  const rotor::State together = after(3e4, rotor::FollowingRing{6e4});
  EXPECT_LE((together - after(2e4, {})).abs().maxCoeff(), 1e-13);
}

/// Forces of all blades in contact balance the ring's spring, and no blade that is not in contact reaches
/// into the ring.
TEST(FollowingRing, BalancesAllBladesWhereverItIsAskedFor) {
  constexpr double kTip = 1e3;
  constexpr double kSpring = 2e3;
  constexpr double kFriction = 0.1;
  constexpr int kBlades = 24;
  const rotor::RotorConstants rotor = rotor_in_following_ring(0.1, 0.012);
  const rotor::BladeSet blades(kBlades, rotor.speed_ratio);
  const auto motion = rigid_blades_in(rotor, kBlades, {kFollowedGeometry, kTip, {kFriction}},
                                      rotor::FollowingRing{kSpring}, 1e-14);
  ASSERT_EQ(start(*motion, rotor::ShaftAndRing(rotor::ShaftAndRing::Zero())), ending::PointStatus::done);
  CountOfBlades count;
  int pushed = 0;
  for (int revolution = 0; revolution < 40; ++revolution) {
    ASSERT_EQ(revolve(*motion, count), ending::PointStatus::done) << revolution;
    const rotor::ShaftAndRing at = motion->state();
    const rotor::State seen = rotor::from_ring(at);
    std::complex<double> push;
    for (int k = 0; k < kBlades; ++k) {
      const auto er = blades.direction(k, blades.first(0.0));
      const std::complex<double> tip(seen[0] + kFollowedGeometry.reach * er.cosine,
                                     seen[1] + rotor.misalignment + kFollowedGeometry.reach * er.sine);
      const double depth = std::abs(tip) - kFollowedGeometry.ring_radius;
      if (depth > 0.0) push += kTip * depth * std::complex<double>(1.0, kFriction) * tip / std::abs(tip);
    }
    EXPECT_LE(std::abs(kSpring * std::complex<double>(at[4], at[5]) - push), 1e-11) << revolution;
    if (std::abs(push) > 0.1) ++pushed;
  }
  EXPECT_GT(pushed, 5);
  EXPECT_GE(count.most, 2U) << "their forces couple";
}

TEST(FollowingRing, WithoutDampingAndFrictionKeepsTheJacobiIntegral) {
  // E − Ω L, with the energy of the shaft, of the ring's spring and of that under each tip.
  constexpr double kTip = 1e4;
  constexpr double kSpring = 3000.0;
  constexpr int kBlades = 24;
  const rotor::RotorConstants rotor = rotor_in_following_ring(0.0, 0.0);
  const rotor::BladeSet blades(kBlades, rotor.speed_ratio);
  const auto integral = [&](const rotor::ShaftAndRing& s) {
    constexpr double kPerTime = 100.0;  // from per τ² to per s²
    double energy = 0.5 * kPerTime * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + s[3] * s[3]) +
                    0.5 * kSpring * (s[4] * s[4] + s[5] * s[5]);
    const rotor::State seen = rotor::from_ring(s);
    for (int k = 0; k < kBlades; ++k) {
      const auto at = pose_of(rotor, kFollowedGeometry, blades.direction(k, blades.first(0.0)), seen);
      const double depth = std::hypot(at.radial + kFollowedGeometry.reach, at.tangential) - 0.11;
      if (depth > 0.0) energy += 0.5 * kTip * depth * depth;
    }
    return energy - rotor.speed_ratio * kPerTime * (s[0] * s[3] - s[1] * s[2]);
  };
  const auto motion =
      rigid_blades_in(rotor, kBlades, {kFollowedGeometry, kTip, {0.0}}, rotor::FollowingRing{kSpring});
  rotor::ShaftAndRing start = rotor::ShaftAndRing::Zero();
  start.head<4>() << 0.008, 0.002, 0.004, 0.009;
  ASSERT_EQ(test::start(*motion, start), ending::PointStatus::done);
  const double before = integral(motion->state());
  CountOfBlades count;
  for (int revolution = 0; revolution < 30; ++revolution) {
    ASSERT_EQ(revolve(*motion, count), ending::PointStatus::done);
    EXPECT_NEAR(integral(motion->state()), before, 1e-10 * std::abs(before)) << revolution;
  }
  EXPECT_GT(motion->work().touchdowns, 20U);
  EXPECT_GE(count.most, 2U);
}

TEST(FollowingRing, AddsNoFreedom) {
  // Volume in the shaft's four dimensions contracts by e^{−4ζT}: without friction the ring's force is a
  // function of position.
  constexpr double kDamping = 0.05;
  const auto map = [&](const Eigen::VectorXd& from) -> Eigen::VectorXd {
    const rotor::RotorConstants rotor = rotor_in_following_ring(kDamping, 0.012);
    const auto motion =
        rigid_blades_in(rotor, 24, {kFollowedGeometry, 1e3, {0.0}}, rotor::FollowingRing{5e3});
    EXPECT_EQ(start(*motion, rotor::State(from.array())), ending::PointStatus::done);
    CountOfBlades count;
    EXPECT_EQ(revolve(*motion, count), ending::PointStatus::done);
    EXPECT_GE(count.most, 2U);
    return rotor::shaft(motion->state()).matrix();
  };
  const double exact = std::exp(-4.0 * kDamping * 2.0 * std::numbers::pi / 0.62);
  const Eigen::Vector4d start(2e-3, -1e-3, 1e-3, 2e-3);
  EXPECT_NEAR(change_of_volume(map, start, 5e-8) / exact, 1.0, 1e-5);
}

TEST(FollowingRing, IsWhatACriticallyDampedRingComesToAsItsMassFalls) {
  const auto after = [](const rotor::Ring& ring) {
    const rotor::RotorConstants rotor = rotor_in_following_ring(0.1, 0.0105);
    const auto motion = rigid_blades_in(rotor, 24, {kFollowedGeometry, 1e3, {0.1}}, ring);
    EXPECT_EQ(start(*motion, rotor::State(0.0, -1e-3, 0.0, 0.0)), ending::PointStatus::done);
    CountOfBlades count;  // no blade touches at the start, where a light ring would be thrown away
    EXPECT_EQ(revolve(*motion, count), ending::PointStatus::done);
    EXPECT_GE(count.most, 2U);
    return rotor::shaft(motion->state());
  };
  const rotor::State limit = after(rotor::FollowingRing{1e4});
  const auto distance = [&](double mass) {
    const rotor::RingBody ring(mass, 1e4, 2.0 * std::sqrt(1e4 * mass), 10.0);
    return (after(ring) - limit).abs().maxCoeff();
  };
  const double light = distance(1e-5);
  EXPECT_GT(light, 1e-10);
  EXPECT_NEAR(std::log2(light / distance(0.25e-5)), 1.0, 0.05) << "first order in the damping left";
}

TEST(FollowingRing, StaysWhereOppositeBladesCancel) {
  const rotor::RotorConstants rotor = rotor_in_following_ring(0.1, 0.0);
  const contact::Geometry tight{0.1101, 0.11};
  for (const int count : {2, 4, 1}) {
    const auto motion = rigid_blades_in(rotor, count, {tight, 1e4, {0.0}}, rotor::FollowingRing{1e3});
    ASSERT_EQ(start(*motion, rotor::ShaftAndRing(rotor::ShaftAndRing::Zero())), ending::PointStatus::done);
    const double pushed = motion->state().segment<2>(4).matrix().norm();
    // One blade alone: both springs share 0.1 mm.
    EXPECT_NEAR(pushed, count == 1 ? 1e-4 * 10.0 / 11.0 : 0.0, 1e-16) << count;
  }
}

TEST(FollowingRing, IsThatOfASceneWithAMassOfZero) {
  nlohmann::json content = {{"grid", {{"speed_ratio", 0.62}}},
                            {"blades", {{"count", 1}}},
                            {"contact", {{"law", "elastic_ring"}, {"friction", 0.0}}},
                            {"ring", {{"stiffness", 3e4}}},
                            {"ring_body", {{"mass", 0.0}, {"compliance", 1.0 / 6e4}}},
                            {"accuracy", {{"tolerance", 1e-13}}},
                            {"protocol", {{"transient_revolutions", 0}, {"sampled_revolutions", 4}}},
                            {"observables", {"poincare", "max_displacement"}}};
  const auto together = run(parsed(content));
  ASSERT_EQ(together.status, ending::PointStatus::done);
  EXPECT_EQ(together.work.touchdowns, 4U);
  EXPECT_EQ(together.final_memory.view().size(), 4U);
  content.erase("ring_body");
  content["ring"]["stiffness"] = 2e4;  // both springs in series
  const auto in_series = run(parsed(content));
  EXPECT_LE(largest_difference(together.final_state, in_series.final_state), 1e-13);
}

}  // namespace
}  // namespace rubatlas::test

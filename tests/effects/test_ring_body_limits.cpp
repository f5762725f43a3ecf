// The ring as one body, very heavy, very stiff and very light: what it then is like, and how fast it becomes
// so.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/elastic_ring_contact.hpp"
#include "contact/elastica_contact.hpp"
#include "solve/blade_tables.hpp"
#include "solve/motion.hpp"
#include "solve/ring_flight.hpp"

namespace rubatlas::test {
namespace {

using solve::PointStatus;
using solve::State;
using FixedRing = effects::NoForcing;
using MovingRing = solve::WithRingBody<effects::NoForcing>;

constexpr double kSpeedOfLimits = 0.62;
constexpr contact::Geometry kLimitGeometry{0.1, 0.11};

contact::ElasticaContact elastic_blade() {
  static solve::BladeTables tables;
  return {kLimitGeometry, {0.1, 1e-3, 206e9 * 0.01 * 1e-9 / 12.0}, tables.curve(0.1)};
}

/// Where the default rotor is after two revolutions from rest (the ring's mass, stiffness and damping in SI).
template <class Law, class Forcing>
State after_two_revolutions(const Law& law, const Forcing& forcing, int blades = 3) {
  const solve::RotorConstants rotor{kSpeedOfLimits, 0.1, 0.01001, 0.01, 0.01};
  solve::Motion<Law, Forcing> motion(rotor, {blades, rotor.speed_ratio}, law, forcing, {1e-15, 0.5});
  EXPECT_EQ(motion.start(State(State::Zero())), PointStatus::done);
  solve::MotionListener nobody;
  for (int revolution = 0; revolution < 2; ++revolution) {
    EXPECT_EQ(motion.revolution(nobody), PointStatus::done);
  }
  EXPECT_GE(motion.work().touchdowns, 2U);
  return solve::shaft(motion.state());
}
template <class Law>
State in_moving_ring(const Law& law, double mass, double stiffness, double damping, int blades = 3) {
  return after_two_revolutions(law, MovingRing{{}, {mass, stiffness, damping, 10.0}}, blades);
}
double farthest(const State& a, const State& b) {
  return (a - b).abs().maxCoeff();
}

TEST(RingBody, AsHeavyAsYouLikeIsTheFixedRingToFirstOrder) {
  const auto expect_first_order = [](const auto& law) {
    const State fixed = after_two_revolutions(law, FixedRing{});
    const double heavy = farthest(in_moving_ring(law, 1e5, 1e4, 0.0), fixed);
    EXPECT_GT(heavy, 1e-10);
    EXPECT_NEAR(heavy / farthest(in_moving_ring(law, 1e6, 1e4, 0.0), fixed), 10.0, 0.1);
  };
  expect_first_order(elastic_blade());
  expect_first_order(contact::ElasticRingContact(kLimitGeometry, 1e4, 0.1));
}

TEST(RingBody, AsStiffAsYouLikeIsTheFixedRingToFirstOrder) {
  // Critically damped: the ring stands where its spring lets it.
  const State fixed = after_two_revolutions(elastic_blade(), FixedRing{});
  const auto at = [&](double stiffness) {
    constexpr double kMass = 0.1;
    return farthest(in_moving_ring(elastic_blade(), kMass, stiffness, 2.0 * std::sqrt(stiffness * kMass)),
                    fixed);
  };
  const double stiff = at(1e5);
  EXPECT_GT(stiff, 1e-9);
  EXPECT_NEAR(std::log10(stiff / at(1e6)), 1.0, 0.15);
}

TEST(RingBody, WithoutMassAndFrictionIsASpringInSeriesWithThatUnderTheTip) {
  // One rigid blade without friction: tip, ring and force are in one line, and the ring's spring adds its
  // compliance to that under the tip. The elastic ring of MODEL 4.7 then is both in one.
  const State series =
      after_two_revolutions(contact::ElasticRingContact(kLimitGeometry, 5e3, 0.0), FixedRing{}, 1);
  const contact::ElasticRingContact tip(kLimitGeometry, 1e4, 0.0);
  const auto at = [&](double part) {  // critically damped at every part
    const double mass = 0.01 * part * part;
    return farthest(in_moving_ring(tip, mass, 1e4, 2.0 * std::sqrt(1e4 * mass), 1), series);
  };
  const double light = at(1.0);
  EXPECT_GT(light, 1e-9);
  EXPECT_NEAR(std::log2(light / at(0.5)), 1.0, 0.25) << "first order in the damping";
}

}  // namespace
}  // namespace rubatlas::test

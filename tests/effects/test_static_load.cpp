// Gravity and side loads against what they must be equal to.
#include <gtest/gtest.h>

#include <numbers>

#include "effect_scene.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;
using motion::SectionState;

constexpr double kQuarterTurn = 0.5 * std::numbers::pi;

settings::Scene default_rotor(settings::ContactLaw law, double speed_ratio) {
  settings::Scene scene;
  scene.contact.law = law;
  scene.grid.speed_ratio = {speed_ratio};
  scene.grid.damping_ratio = {scene.rotor.damping_ratio};
  scene.grid.friction = {scene.contact.friction};
  scene.grid.unbalance = {0.0};
  scene.grid.thickness = {scene.blades.thickness};
  scene.protocol = {0, 4, 64};
  scene.accuracy.tolerance = 1e-13;
  scene.observables = {"poincare", "max_contact_force"};
  return scene;
}

double shaft_stiffness(const settings::Scene& scene) {
  return scene.rotor.mass * scene.rotor.natural_frequency * scene.rotor.natural_frequency;
}

class StaticLoad : public ::testing::TestWithParam<settings::ContactLaw> {};

TEST_P(StaticLoad, AlongTheMisalignmentIsAMisalignmentWithTheOriginMoved) {
  for (const double deflection : {1e-3, 3e-4}) {
    for (const double speed : {0.3, 0.62}) {
      settings::Scene loaded = default_rotor(GetParam(), speed);
      loaded.side_load = effects::SideLoad{deflection * shaft_stiffness(loaded), kQuarterTurn};
      settings::Scene moved = default_rotor(GetParam(), speed);
      moved.rotor.misalignment += deflection;
      const SectionState start{1e-3, 5e-4, 0.0, 1e-3};
      const auto with_load = run(loaded, start);
      const auto with_offset = run(moved, {start[0], start[1] - deflection, start[2], start[3]});
      ASSERT_EQ(with_load.status, PointStatus::done);
      ASSERT_GT(with_load.work.touchdowns, 0U);
      EXPECT_EQ(with_load.work.touchdowns, with_offset.work.touchdowns);
      for (std::size_t i = 0; i < with_load.rows[0].size(); ++i) {
        const double origin = i % 4 == 1 ? deflection : 0.0;
        EXPECT_NEAR(with_load.rows[0][i], with_offset.rows[0][i] + origin, 1e-12) << "entry " << i;
      }
    }
  }
}

TEST_P(StaticLoad, LetsABladePassNearestOnTheSectionAtItsDistanceThere) {
  // Along x, where the only blade is at the section: it passes at the clearance less the deflection.
  for (int i = 10; i <= 50; ++i) {
    settings::Scene scene = default_rotor(GetParam(), 0.02 * i);
    scene.blades.count = 1;
    scene.rotor.misalignment = 0.0;
    scene.rotor.damping_ratio = 0.5;
    scene.protocol.transient_revolutions = 200;
    scene.side_load = effects::SideLoad{0.9};
    scene.observables = {"nearest_miss"};
    const double deflection = 0.9 / shaft_stiffness(scene);
    EXPECT_NEAR(run(scene).rows[0][0], scene.clearance() - deflection, 1e-12) << 0.02 * i;
  }
}

TEST_P(StaticLoad, OfTheRotorsWeightIsGravity) {
  // Powers of two: mass and stiffness scale without rounding.
  settings::Scene heavy = default_rotor(GetParam(), 0.45);
  heavy.rotor.mass = 2.0;
  heavy.rotor.natural_frequency = 8.0;
  settings::Scene loaded = heavy;
  heavy.gravity = effects::Gravity{0.1, 0.3};
  loaded.side_load = effects::SideLoad{2.0 * 0.1, 0.3};
  const auto weight = run(heavy);
  ASSERT_EQ(weight.status, PointStatus::done);
  EXPECT_GT(weight.work.touchdowns, 0U);
  EXPECT_EQ(weight.rows, run(loaded).rows);
}

TEST_P(StaticLoad, TwoLoadsAreTheirSum) {
  settings::Scene two = default_rotor(GetParam(), 0.45);
  settings::Scene one = two;
  two.gravity = effects::Gravity{0.05, kQuarterTurn};  // 0.05 N along y
  two.side_load = effects::SideLoad{0.1, 0.0};
  one.side_load = effects::SideLoad{std::hypot(0.05, 0.1), std::atan2(0.05, 0.1)};
  const auto sum = run(one);
  ASSERT_EQ(sum.status, PointStatus::done);
  EXPECT_LE(largest_difference(run(two).rows[0], sum.rows[0]), 1e-12);
}

TEST_P(StaticLoad, TurnedTogetherWithTheBladesTurnsTheMotion) {
  // A centred ring is round: the load is all that tells one direction from another.
  constexpr double kAngle = 0.7;
  const std::complex<double> turn = std::polar(1.0, kAngle);
  settings::Scene scene = default_rotor(GetParam(), 0.62);
  scene.rotor.misalignment = 0.0;
  scene.side_load = effects::SideLoad{0.0105 * shaft_stiffness(scene), 0.2};
  const auto motion = run(scene);
  scene.side_load->direction += kAngle;
  scene.unequal_blades.emplace().angle_errors = {kAngle, kAngle, kAngle};
  const auto turned = run(scene);
  ASSERT_EQ(motion.status, PointStatus::done);
  ASSERT_EQ(turned.status, PointStatus::done);
  ASSERT_GT(motion.work.touchdowns, 0U);
  for (std::size_t i = 0; i < motion.rows[0].size(); i += 2) {
    const std::complex<double> expected = turn * std::complex(motion.rows[0][i], motion.rows[0][i + 1]);
    EXPECT_NEAR(turned.rows[0][i], expected.real(), 1e-12) << "entry " << i;
    EXPECT_NEAR(turned.rows[0][i + 1], expected.imag(), 1e-12) << "entry " << i + 1;
  }
}

TEST_P(StaticLoad, TooSmallToMatterGivesTheMotionWithoutThroughTheOtherKernel) {
  settings::Scene scene = default_rotor(GetParam(), 0.62);
  const auto plain = run(scene);
  scene.side_load = effects::SideLoad{1e-300, 0.0};
  const auto loaded = run(scene);
  ASSERT_EQ(plain.status, PointStatus::done);
  EXPECT_EQ(loaded.work.touchdowns, plain.work.touchdowns);
  EXPECT_LE(largest_difference(loaded.rows[0], plain.rows[0]), 1e-12);
}

TEST_P(StaticLoad, WithoutContactBringsTheRotorToRestWhereStaticsSays) {
  settings::Scene scene = default_rotor(GetParam(), 0.5);
  scene.rotor.misalignment = 0.0;
  scene.rotor.damping_ratio = 0.5;
  scene.grid.damping_ratio = {0.5};
  scene.protocol.transient_revolutions = 20;
  scene.side_load = effects::SideLoad{0.4, 1.1};
  const auto outcome = run(scene);
  const double deflection = 0.4 / shaft_stiffness(scene);
  EXPECT_EQ(outcome.work.touchdowns, 0U);
  const SectionState rest{deflection * std::cos(1.1), deflection * std::sin(1.1), 0.0, 0.0};
  EXPECT_LE(largest_difference(outcome.final_state, rest), 1e-16);
}

INSTANTIATE_TEST_SUITE_P(Laws, StaticLoad,
                         ::testing::Values(settings::ContactLaw::elastica,
                                           settings::ContactLaw::elastic_ring),
                         [](const auto& instance) {
                           return instance.param == settings::ContactLaw::elastica ? "elastica"
                                                                                   : "elastic_ring";
                         });

}  // namespace
}  // namespace rubatlas::test

/// What holds exactly for this model, whatever the parameters: no reference needed.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "../support/point.hpp"
#include "../support/section_differences.hpp"
#include "rotor/constants.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;
using motion::SectionState;

settings::Scene default_scene(settings::ContactLaw law) {
  settings::Scene scene = default_rotor(6);
  scene.contact.law = law;
  scene.observables = {"poincare", "poincare_blade_passing", "max_displacement"};
  scene.accuracy.tolerance = 1e-13;
  return scene;
}

class Invariants : public ::testing::TestWithParam<settings::ContactLaw> {};

TEST_P(Invariants, PhaseVolumeContractsByTheDampingAlone) {
  // det of the section map's Jacobian = e^{−4ζT}: forces depend on position only; no slip reverses here.
  settings::Scene scene = default_scene(GetParam());
  scene.rotor.damping_ratio = 0.05;
  scene.protocol.sampled_revolutions = 1;
  const double speed = 0.62;
  const SectionState start{2e-3, -1e-3, 1e-3, 2e-3};
  const auto map = [&](const Eigen::VectorXd& from) -> Eigen::VectorXd {
    const auto outcome = run(scene, speed, {from[0], from[1], from[2], from[3]});
    EXPECT_EQ(outcome.status, PointStatus::done);
    EXPECT_EQ(outcome.work.slip_reversals, 0U);
    EXPECT_GT(outcome.work.touchdowns, 0U);
    return rotor::as_state(outcome.final_state).matrix();
  };
  const double exact = std::exp(-4.0 * scene.rotor.damping_ratio * 2.0 * std::numbers::pi / speed);
  EXPECT_NEAR(change_of_volume(map, rotor::as_state(start).matrix(), 1e-7) / exact, 1.0, 1e-6);
}

TEST_P(Invariants, TwiceTheMassStiffnessAndUnbalanceMovesTheSame) {
  settings::Scene scene = default_scene(GetParam());
  scene.unbalance = settings::Unbalance{1e-4, 0.3};
  const auto once = run(scene, 0.62);
  scene.rotor.mass *= 2.0;
  scene.blades.youngs_modulus *= 2.0;
  scene.ring.stiffness *= 2.0;
  scene.unbalance->moment *= 2.0;
  const auto twice = run(scene, 0.62);
  ASSERT_EQ(once.status, PointStatus::done);
  ASSERT_GT(once.work.touchdowns, 0U);
  EXPECT_EQ(once.rows, twice.rows) << "powers of two scale without rounding";
}

TEST_P(Invariants, TwiceTheLengthsAreTwiceTheMotion) {
  settings::Scene scene = default_scene(GetParam());
  scene.unbalance = settings::Unbalance{1e-4, 0.3};
  const auto once = run(scene, 0.62);
  // EI × 2³ with L × 2 keeps F/L: E b h³/12 with b, h doubled is 2⁴ EI.
  scene.blades.length *= 2.0;
  scene.blades.width *= 2.0;
  scene.blades.thickness *= 2.0;
  scene.blades.youngs_modulus *= 0.5;
  scene.ring.radius *= 2.0;
  scene.rotor.misalignment *= 2.0;
  scene.unbalance->moment *= 2.0;
  const auto twice = run(scene, 0.62);
  ASSERT_EQ(twice.status, PointStatus::done);
  ASSERT_EQ(once.rows[0].size(), twice.rows[0].size());
  for (std::size_t i = 0; i < once.rows[0].size(); ++i) {
    EXPECT_NEAR(twice.rows[0][i], 2.0 * once.rows[0][i], 1e-12) << "entry " << i;
  }
}

TEST_P(Invariants, WithoutUnbalanceEveryBladePassingIsASection) {
  // Blades are equal: starting blade 1 where blade 3 stood gives the same motion one passing later.
  const settings::Scene scene = default_scene(GetParam());
  const auto outcome = run(scene, 0.4, {1e-3, 0.0, 0.0, 1e-3});
  ASSERT_EQ(outcome.status, PointStatus::done);
  const auto shifted = run(scene, 0.4, section(outcome.rows[1], 0));
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t component = 0; component < 4; ++component) {
      EXPECT_NEAR(shifted.rows[1][4 * i + component], outcome.rows[1][4 * (i + 1) + component], 1e-11)
          << "passing " << i;
    }
  }
}

TEST_P(Invariants, AMotionContinuedFromItsSectionIsTheSameMotion) {
  settings::Scene scene = default_scene(GetParam());
  const auto whole = run(scene, 0.62);
  scene.protocol.sampled_revolutions = 3;
  const auto first = run(scene, 0.62);
  const auto second = run(scene, 0.62, first.final_state);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_NEAR(first.rows[0][i], whole.rows[0][i], 1e-13);
    EXPECT_NEAR(second.rows[0][i], whole.rows[0][12 + i], 1e-11);
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, Invariants,
                         ::testing::Values(settings::ContactLaw::elastica,
                                           settings::ContactLaw::elastic_ring),
                         [](const auto& instance) {
                           return instance.param == settings::ContactLaw::elastica ? "elastica"
                                                                                   : "elastic_ring";
                         });

}  // namespace
}  // namespace rubatlas::test

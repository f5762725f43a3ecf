/// Lyapunov exponents of motions whose exponents are known, or bound by what they must add up to.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <vector>

#include "../support/point.hpp"
#include "integrate/decompositions.hpp"

namespace rubatlas::test {
namespace {

struct Exponents {
  std::vector<double> values;
  std::vector<double> errors;
  double residual;
};

settings::Scene with_exponents(int transient, int sampled) {
  settings::Scene scene = default_rotor(sampled);
  scene.protocol.transient_revolutions = transient;
  scene.observables = {"lyapunov"};
  return scene;
}

Exponents exponents(const settings::Scene& scene, double speed_ratio,
                    const motion::SectionState& start = {}) {
  const auto outcome = run(scene, speed_ratio, start);
  EXPECT_EQ(outcome.status, ending::PointStatus::done);
  return {outcome.rows[0], outcome.rows[1], outcome.rows[2][0]};
}

TEST(Lyapunov, ExponentsOfARotorThatNeverTouchesAreItsDamping) {
  for (const double damping : {0.0, 0.02, 0.1, 0.5}) {
    settings::Scene scene = with_exponents(0, 100);
    scene.rotor.misalignment = 0.0;
    scene.rotor.damping_ratio = damping;
    const Exponents found = exponents(scene, 0.4, {1e-3, 0.0, 0.0, 0.0});
    // The multipliers are complex: the tangents turn, and what they turn in the last revolution stays over.
    const double turning = 2.0 / (75.0 * 2.0 * std::numbers::pi / 0.4);
    for (const double exponent : found.values) EXPECT_NEAR(exponent, -damping, turning) << damping;
    EXPECT_NEAR(found.residual, 0.0, 1e-13);
  }
}

TEST(Lyapunov, ExponentsOfAnOverdampedRotorAreItsTwoRates) {
  settings::Scene scene = with_exponents(0, 100);
  scene.rotor.misalignment = 0.0;
  scene.rotor.damping_ratio = 1.25;
  const Exponents found = exponents(scene, 2.0, {1e-3, 0.0, 0.0, 0.0});
  EXPECT_NEAR(found.values[0], -0.5, 1e-12) << "ζ less ωd = 3/4";
  EXPECT_NEAR(found.values[1], -0.5, 1e-12);
  EXPECT_NEAR(found.values[2], -2.0, 1e-12);
  EXPECT_NEAR(found.values[3], -2.0, 1e-12);
  for (const double error : found.errors) EXPECT_LT(error, 1e-12);
}

TEST(Lyapunov, TheSumIsThatOfTheDampingWhereNoSlipReverses) {
  for (const auto law : {settings::ContactLaw::elastica, settings::ContactLaw::elastic_ring}) {
    settings::Scene scene = with_exponents(100, 50);
    scene.contact.law = law;
    for (const double speed : {0.1, 0.31, 0.36, 0.45, 0.5, 0.62, 0.7, 0.85}) {
      const Exponents found = exponents(scene, speed);
      EXPECT_LE(std::abs(found.residual), 1e-6) << "speed ratio " << speed;
    }
  }
}

TEST(Lyapunov, ARingThatIsABodyAddsItsOwnFour) {
  settings::Scene scene = with_exponents(0, 100);
  scene.rotor.misalignment = 0.0;
  scene.ring_body = effects::RingBody{.mass = 0.5, .compliance = 1e-3, .damping = 4.0};
  const Exponents found = exponents(scene, 0.4, {1e-3, 0.0, 0.0, 0.0});
  ASSERT_EQ(found.values.size(), 8U);
  // c_r/(2 m_r ωn), of the ring that nothing touches.
  const double of_ring = 4.0 / (2.0 * 0.5 * 10.0);
  const double turning = 2.0 / (75.0 * 2.0 * std::numbers::pi / 0.4);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(found.values[i], -0.1, turning);
    EXPECT_NEAR(found.values[4 + i], -of_ring, turning);
  }
  EXPECT_NEAR(found.residual, 0.0, 1e-12);
}

TEST(Lyapunov, ExponentsOfARingWhoseMotionDiesAtOnceAreNotFollowedAndThePointEnds) {
  settings::Scene scene = with_exponents(0, 1);
  scene.rotor.misalignment = 0.0;
  scene.ring_body = effects::RingBody{.mass = 1.0, .compliance = 1e-3, .damping = 1e15};
  const auto outcome = run(scene, 1e-4, motion::SectionState{1e-3, 0.0, 0.0, 0.0});
  EXPECT_EQ(outcome.status, ending::PointStatus::done);
  ASSERT_EQ(outcome.rows[0].size(), 8U);
  for (const double exponent : outcome.rows[0]) EXPECT_TRUE(std::isnan(exponent));
}

TEST(Lyapunov, TheSumIsThatOfTheDampersOnAnySupportAndInARingThatIsABody) {
  settings::Scene supported = with_exponents(100, 50);
  supported.support = effects::Support{.stiffness_xx = 20.0, .damping_yy = 0.5, .rotating_damping = 0.3};
  settings::Scene in_ring = with_exponents(100, 50);
  in_ring.ring_body = effects::RingBody{.mass = 0.5, .compliance = 1e-4, .damping = 3.0};
  for (const settings::Scene& scene : {supported, in_ring}) {
    for (const double speed : {0.31, 0.36, 0.5, 0.62}) {
      const Exponents found = exponents(scene, speed);
      EXPECT_LE(std::abs(found.residual), 1e-6) << "speed ratio " << speed;
    }
  }
}

TEST(Lyapunov, TheLargestIsNegativeOnPeriodicMotionsAndPositiveOnChaoticOnes) {
  const settings::Scene scene = with_exponents(300, 300);
  for (const double speed : {0.2, 0.36, 0.42, 0.62})
    EXPECT_LT(exponents(scene, speed).values[0], 0.0) << speed;
  for (const double speed : {0.46, 0.5}) {
    const Exponents found = exponents(scene, speed);
    EXPECT_GT(found.values[0], 3.0 * found.errors[0]) << speed;
  }
}

TEST(Lyapunov, ExponentsAreThoseOfTheMultipliersOfAPeriodicMotion) {
  const settings::Scene scene = with_exponents(300, 400);
  const auto solver = solver_of(scene);
  for (const double speed : {0.36, 0.42, 0.62}) {
    const Exponents found = exponents(scene, speed);
    const auto settled = solver->section_map(speed, {}, 300);
    const auto map = solver->section_map(speed, settled.sections.back(), 1);
    const double largest = integrate::eigen_modes(map.jacobian).values.cwiseAbs().maxCoeff();
    const double duration = 2.0 * std::numbers::pi / speed;
    EXPECT_NEAR(found.values[0], std::log(largest) / duration, 2e-3) << speed;
  }
}

}  // namespace
}  // namespace rubatlas::test

/// Coordinates of the states in which a tip stands on the ring.
#include <gtest/gtest.h>

#include <cmath>

#include "../support/point.hpp"
#include "branch/touchdown_chart.hpp"

namespace rubatlas::test {
namespace {

constexpr double kSpeedRatio = 0.43;

TEST(TouchdownChart, HoldsStatesInWhichTheTipStandsOnTheRingAndApproachesItAsSaid) {
  const settings::Scene scene = default_rotor(1);
  const branch::TouchdownChart chart(scene, kSpeedRatio, 2);
  const branch::TouchdownCoordinates at(1.7, 3e-3, 2e-3, -1e-3);
  const Eigen::Vector4d state = chart.state(at);
  const double angle = 1.7 + 4.0 * std::acos(-1.0) / 3.0;  // of the third blade
  const double reach = scene.blades.hub_radius + scene.blades.length;
  const Eigen::Vector2d tip(state[0] + reach * std::cos(angle),
                            state[1] + scene.rotor.misalignment + reach * std::sin(angle));
  EXPECT_NEAR(tip.norm(), scene.ring.radius, 1e-16);
  const Eigen::Vector2d velocity =
      state.tail<2>() + kSpeedRatio * reach * Eigen::Vector2d(-std::sin(angle), std::cos(angle));
  EXPECT_NEAR(velocity.dot(tip.normalized()), 2e-3, 1e-16) << "d|w|/dτ";
}

TEST(TouchdownChart, GivesBackTheCoordinatesOfAState) {
  const branch::TouchdownChart chart(default_rotor(1), kSpeedRatio, 1);
  const branch::TouchdownCoordinates at(0.9, -4e-3, 5e-4, 2e-2);
  const Eigen::Vector4d state = chart.state(at);
  const auto found = chart.coordinates(at[0] / kSpeedRatio, {state[0], state[1], state[2], state[3]});
  EXPECT_LT((found - at).norm(), 1e-15);
}

TEST(TouchdownChart, HasTheDerivativeOfItsStates) {
  const branch::TouchdownChart chart(default_rotor(1), kSpeedRatio, 0);
  const branch::TouchdownCoordinates at(4.1, 2e-3, 1e-3, 3e-2);
  const Eigen::Matrix4d found = chart.derivative(at);
  constexpr double kStep = 1e-4;
  for (int i = 0; i < 4; ++i) {
    const branch::TouchdownCoordinates step = kStep * branch::TouchdownCoordinates::Unit(i);
    const Eigen::Vector4d difference = (8.0 * (chart.state(at + step) - chart.state(at - step)) -
                                        (chart.state(at + 2.0 * step) - chart.state(at - 2.0 * step))) /
                                       (12.0 * kStep);
    EXPECT_LT((found.col(i) - difference).norm(), 1e-11) << i;
  }
}

}  // namespace
}  // namespace rubatlas::test

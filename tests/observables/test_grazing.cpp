/// Passes and touches of tips that are known exactly.
#include <gtest/gtest.h>

#include <cmath>

#include "observables/grazing.hpp"
#include "synthetic_motion.hpp"

namespace rubatlas::observables {
namespace {

constexpr double kRadius = 0.11;

trajectory::State resting(double /*time*/) {
  return {0, 0, 0, 0};
}

double number_in(Observable& observable) {
  std::vector<double> row(1);
  observable.write(row);
  return row[0];
}

settings::Scene scene_with(int blades) {
  settings::Scene scene;
  scene.blades.count = blades;
  scene.ring.radius = kRadius;
  return scene;
}

/// A tip whose overlap is `top` − (t − at)² [m].
trajectory::Tip parabola(double time, double at, double top, double side) {
  return {top - (time - at) * (time - at), -2.0 * (time - at), side};
}

/// Hands over a piece from `begin` to `end` with these tips, in contact with the blades of `contacts`.
void hand_over(Observable& observable, double begin, double end,
               std::function<trajectory::Tip(int, double)> tips,
               const std::vector<int>& blades_in_contact = {}) {
  std::vector<SyntheticContact> contacts;
  const auto none = [](double) { return 0.0; };
  for (const int blade : blades_in_contact) contacts.push_back({blade, none, none});
  SyntheticPiece piece(begin, end, resting, contacts);
  piece.set_tips(std::move(tips));
  observable.piece(piece);
}

TEST(NearestMiss, IsTheSmallestDistanceByWhichATipPassesTheRing) {
  NearestMiss miss;
  miss.begin(point_at(0.5, 2));
  const auto tips = [](int blade, double time) {
    return blade == 0 ? parabola(time, 3.3, -2e-3, 1e-3) : parabola(time, 7.9, -1e-3, -1e-3);
  };
  hand_over(miss, 0.0, 5.0, tips);
  EXPECT_NEAR(number_in(miss), 2e-3, 1e-15);
  hand_over(miss, 5.0, 10.0, tips);
  EXPECT_NEAR(number_in(miss), 1e-3, 1e-15);
}

TEST(NearestMiss, IsNotANumberWhereNoRadiusHasAMaximum) {
  NearestMiss miss;
  miss.begin(point_at(0.5, 1));
  hand_over(miss, 0.0, 5.0, [](int, double time) { return trajectory::Tip{-1e-2 + 1e-3 * time, 1e-3, 0.0}; });
  EXPECT_TRUE(std::isnan(number_in(miss)));
}

TEST(NearestMiss, LeavesOutTheTipThatIsInContact) {
  NearestMiss miss;
  miss.begin(point_at(0.5, 2));
  const auto tips = [](int blade, double time) {
    return blade == 0 ? parabola(time, 0.5, -1e-9, 0.0) : parabola(time, 0.6, -3e-3, 0.0);
  };
  hand_over(miss, 0.0, 1.0, tips, {0});
  EXPECT_NEAR(number_in(miss), 3e-3, 1e-15) << "the other tip passes meanwhile";
}

TEST(LightestTouch, IsTheLeastOfTheLargestOverlapsOfTheContacts) {
  LightestTouch touch(2);
  touch.begin(point_at(0.5, 2));
  const auto deep = [](int, double time) { return parabola(time, 1.0, 4e-3, 1e-3); };
  const auto light = [](int, double time) { return parabola(time, 3.1, 1e-3, 1e-3); };
  touch.touch_down(0);
  hand_over(touch, 0.95, 1.05, deep, {0});
  touch.lift_off(0);
  EXPECT_NEAR(number_in(touch), 4e-3, 1e-14);
  touch.touch_down(1);
  hand_over(touch, 3.07, 3.09, light, {1});
  hand_over(touch, 3.09, 3.13, light, {1});
  touch.lift_off(1);
  EXPECT_NEAR(number_in(touch), 1e-3, 1e-14);
}

TEST(LightestTouch, KeepsItsDigitsInAContactThatLastsAMillionthOfTheTimeBefore) {
  for (int i = 1; i < 20; ++i) {
    LightestTouch touch(1);
    touch.begin(point_at(0.1, 1));
    const double begin = 62.0;
    const double end = begin + 6e-5;
    const double top = begin + (end - begin) * i / 20;
    const auto light = [&](int, double time) { return parabola(time, top, 1e-9, 0.0); };
    touch.touch_down(0);
    hand_over(touch, begin, end, light, {0});
    touch.lift_off(0);
    EXPECT_NEAR(number_in(touch), 1e-9, 1e-18) << i;
  }
}

TEST(LightestTouch, CountsOnlyContactsThatAreSeenWhole) {
  LightestTouch touch(1);
  touch.begin(point_at(0.5, 1));
  const auto overlap = [](int, double time) { return parabola(time, 1.0, 1e-4, 0.0); };
  hand_over(touch, 0.995, 1.005, overlap, {0});
  touch.lift_off(0);
  EXPECT_TRUE(std::isnan(number_in(touch))) << "it was open when the sampled revolutions began";
  touch.touch_down(0);
  hand_over(touch, 0.995, 1.005, overlap, {0});
  EXPECT_TRUE(std::isnan(number_in(touch))) << "it is open when they end";
}

TEST(NearestGrazing, HasTheSideOfTheMissOrTheTouchThatIsNearerToZero) {
  NearestGrazing grazing(scene_with(1));
  const auto pass = [&](double miss, double side) {
    hand_over(grazing, 0.0, 1.0, [=](int, double time) { return parabola(time, 0.4, -miss, side); });
  };
  grazing.begin(point_at(0.5, 1));
  EXPECT_EQ(number_in(grazing), 0.0) << "there is neither";
  pass(1e-3, 2e-3);
  EXPECT_EQ(number_in(grazing), 1.0) << "approaching";
  pass(1e-4, -2e-3);
  EXPECT_EQ(number_in(grazing), 3.0) << "receding";
  pass(1e-5, 1e-14);
  EXPECT_EQ(number_in(grazing), 2.0) << "head-on";
  grazing.touch_down(0);
  hand_over(grazing, 2.0, 2.006, [](int, double time) { return parabola(time, 2.003, 1e-6, 5e-3); }, {0});
  grazing.lift_off(0);
  EXPECT_EQ(number_in(grazing), 1.0) << "a touch lighter than any miss";
}

}  // namespace
}  // namespace rubatlas::observables

// The ring as one body, very heavy, very stiff and very light.
#include <gtest/gtest.h>

#include <cmath>

#include "effect_scene.hpp"

namespace rubatlas::test {
namespace {

using solve::PointStatus;

scene::Scene ring_body_scene(double speed, int revolutions, double mass, double compliance, double damping) {
  auto scene = effect_scene<&effects::Effects::ring_body>(speed, revolutions);
  scene["ring_body"] = {{"mass", mass}, {"compliance", compliance}, {"damping", damping}};
  scene["accuracy"]["tolerance"] = 1e-13;
  return parsed(scene);
}

/// How far the motion is from that in a ring that does not move [m].
double distance_to_fixed(scene::Scene scene) {
  const auto moving = run(scene);
  scene.ring_body.reset();
  const auto fixed = run(scene);
  EXPECT_EQ(moving.status, PointStatus::done);
  EXPECT_EQ(fixed.status, PointStatus::done);
  EXPECT_GT(fixed.work.touchdowns, 3U);
  return largest_difference(moving.final_state, fixed.final_state);
}

TEST(RingBody, AsHeavyAsYouLikeIsTheFixedRingToFirstOrder) {
  for (const auto law : {scene::ContactLaw::elastica, scene::ContactLaw::elastic_ring}) {
    const auto at = [&](double mass) {
      scene::Scene scene = ring_body_scene(0.62, 2, mass, 1e-4, 0.0);
      scene.contact.law = law;
      return distance_to_fixed(scene);
    };
    const double heavy = at(1e5);
    EXPECT_GT(heavy, 1e-9);
    EXPECT_NEAR(heavy / at(1e6), 10.0, 0.5);
  }
}

TEST(RingBody, AsStiffAsYouLikeIsTheFixedRingToFirstOrder) {
  // Critically damped, at the same mass ratio: the ring stands where its spring lets it.
  const auto at = [](double stiffness) {
    const double mass = 1e-2;
    return distance_to_fixed(
        ring_body_scene(0.62, 2, mass, 1.0 / stiffness, 2.0 * std::sqrt(stiffness * mass)));
  };
  const double stiff = at(1e6);
  EXPECT_GT(stiff, 1e-9);
  EXPECT_NEAR(std::log10(stiff / at(1e7)), 1.0, 0.25);
}

TEST(RingBody, WithoutMassAndFrictionIsASpringInSeriesWithThatUnderTheTip) {
  // One rigid blade without friction: tip, ring and force are in one line, and the ring's spring adds to that
  // under the tip (the elastic ring of MODEL 4.7, whose body yields under one blade as it does under the
  // tip).
  scene::Scene series = ring_body_scene(0.62, 2, 1.0, 1e-4, 0.0);
  series.ring_body.reset();
  series.contact = {scene::ContactLaw::elastic_ring, 0.0};
  series.blades.count = 1;
  series.ring.stiffness = 5e3;
  const auto limit = run(series);
  ASSERT_EQ(limit.status, PointStatus::done);
  ASSERT_GT(limit.work.touchdowns, 1U);
  const auto at = [&](double part) {
    scene::Scene scene = series;
    scene.ring.stiffness = 1e4;
    scene.ring_body = effects::RingBody{1e-3 * part * part, 1e-4, 4.0 * part};
    const auto outcome = run(scene);
    EXPECT_EQ(outcome.status, PointStatus::done);
    return largest_difference(outcome.final_state, limit.final_state);
  };
  const double light = at(1.0);
  EXPECT_GT(light, 1e-9);
  EXPECT_NEAR(light / at(0.25), 4.0, 0.8) << "first order in damping and the root of the mass";
}

}  // namespace
}  // namespace rubatlas::test

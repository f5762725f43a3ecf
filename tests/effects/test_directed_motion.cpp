// Blades whose two unknowns are solved for at each place, against the same blades carried along as a state.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "../support/hybrid_motion.hpp"
#include "directed_law.hpp"

namespace rubatlas::test {
namespace {

RecordedMotion from_rest(const HardRotor& rotor, const auto& law) {
  return follow(rotor, law, kNoForcing, rotor::State::Zero(), 200, [](trajectory::MotionPiece&) {});
}

/// Of the last sections, from one to the next [m].
double closing_distance(const RecordedMotion& motion) {
  double largest = 0.0;
  for (std::size_t i = motion.sections.size() - 40; i < motion.sections.size(); ++i) {
    largest = std::max(largest, (motion.sections[i] - motion.sections[i - 1]).abs().maxCoeff());
  }
  return largest;
}

TEST(DirectedMotion, RepeatsItselfToRoundingWhereItIsPeriodicOnTheOrbitOfTheCarriedLaw) {
  for (const double speed : {0.2, 0.37, 0.42, 0.65}) {
    SCOPED_TRACE(speed);
    HardRotor rotor;
    rotor.speed_ratio = speed;
    rotor.tolerance = 1e-9;
    const auto carried = from_rest(rotor, rotor.elastica());
    const auto solved = from_rest(rotor, directed_law(rotor, contact::Friction::coulomb(rotor.friction)));
    ASSERT_EQ(carried.status, ending::PointStatus::done);
    ASSERT_EQ(solved.status, ending::PointStatus::done);
    EXPECT_LE(closing_distance(carried), 1e-14);
    EXPECT_LE(closing_distance(solved), 1e-14);
    // A step may err by 1e-11 m, and these orbits forget an error only in some ten to a hundred revolutions.
    EXPECT_LE((carried.sections.back() - solved.sections.back()).abs().maxCoeff(), 1e-8);
  }
}

/// Where a motion is after some revolutions, or how far it came.
struct Course {
  ending::PointStatus status;
  std::size_t revolutions;
  rotor::State state;
};
Course course(HardRotor rotor, const auto& law, const rotor::State& start, double tolerance) {
  rotor.tolerance = tolerance;
  const auto motion = follow(rotor, law, kNoForcing, start, 5, [](trajectory::MotionPiece&) {});
  const bool done = motion.status == ending::PointStatus::done;
  return {motion.status, motion.sections.size(), done ? motion.sections.back() : start};
}

/// Two tolerances and a start a little aside. True where the motion is predictable: nothing but the tolerance
/// could change its outcome.
bool ends_alike(const HardRotor& rotor, const auto& law, const rotor::State& start) {
  constexpr double kAside = 1e-11;
  const Course rough = course(rotor, law, start, 1e-9);
  const Course fine = course(rotor, law, start, 1e-10);
  if (rough.status == fine.status && rough.revolutions == fine.revolutions) return true;
  rotor::State aside = start;
  aside[0] += kAside;
  const Course finest = course(rotor, law, start, 1e-12);
  const Course moved = course(rotor, law, aside, 1e-12);
  const bool predictable = finest.status == moved.status && finest.revolutions == moved.revolutions &&
                           (finest.state - moved.state).abs().maxCoeff() < 1e4 * kAside;
  EXPECT_FALSE(predictable) << "after " << rough.revolutions << " and " << fine.revolutions << " revolutions";
  return false;
}

TEST(DirectedMotion, StatusOfAPredictableMotionDoesNotHangOnTheTolerance) {
  int alike = 0;
  constexpr int kScenes = 24;
  for (int i = 0; i < kScenes; ++i) {
    SCOPED_TRACE(i);
    std::mt19937_64 random(static_cast<std::uint64_t>(1048 + i));
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const auto between = [&](double least, double most) {
      return least * std::pow(most / least, uniform(random));
    };
    HardRotor rotor;
    rotor.speed_ratio = between(0.08, 0.8);
    rotor.damping_ratio = between(0.02, 0.3);
    rotor.friction = between(0.03, 0.5);
    rotor::State start;
    for (int k = 0; k < 4; ++k) start[k] = (k < 2 ? 0.005 : 0.03) * (2 * uniform(random) - 1);
    if (i % 3 == 0) start.setZero();
    const double v0 = between(1e-5, 0.1);
    const contact::Friction regularised = contact::Friction::regularised(rotor.friction, v0);
    const contact::Friction stribeck =
        contact::Friction::stribeck(uniform(random), rotor.friction, between(1e-4, 0.1), 0.3 * v0);
    bool same = false;
    if (i % 4 == 0) same = ends_alike(rotor, directed_law(rotor, regularised), start);
    if (i % 4 == 1) same = ends_alike(rotor, directed_law(rotor, stribeck), start);
    if (i % 4 == 2) {
      same = ends_alike(rotor, directed_law(rotor, regularised, contact::LoadDirection::normal), start);
    }
    if (i % 4 == 3) {
      same = ends_alike(rotor, directed_law(rotor, stribeck, contact::LoadDirection::normal), start);
    }
    alike += same ? 1 : 0;
  }
  EXPECT_GE(alike, kScenes - 3);
}

TEST(DirectedMotion, NoForceIsMissedAtAnOrdinaryTouchDownNorShortlyBeforeALiftOff) {
  HardRotor fast;
  fast.speed_ratio = 0.5;
  HardRotor kicked;
  kicked.speed_ratio = 0.1579;
  kicked.damping_ratio = 0.02245;
  kicked.friction = 0.3975;
  rotor::State kick;
  kick << 3.519e-3, 3.498e-3, 0.0142, -0.01473;
  for (const double tolerance : {1e-9, 1e-10}) {
    const Course from_rest =
        course(fast, directed_law(fast, contact::Friction::stribeck(0.8, 0.1, 0.01, 0.002)),
               rotor::State::Zero(), tolerance);
    EXPECT_EQ(from_rest.status, ending::PointStatus::done);
    const Course from_kick = course(
        kicked, directed_law(kicked, contact::Friction::regularised(0.3975, 0.06257)), kick, tolerance);
    EXPECT_EQ(from_kick.status, ending::PointStatus::done);
  }
}

}  // namespace
}  // namespace rubatlas::test

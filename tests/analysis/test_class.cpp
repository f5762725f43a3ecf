// Classes of motions whose period is known by construction.
#include "analysis/rules/class.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace rubatlas::analysis {
namespace {

using States = std::vector<double>;
constexpr ClosingTolerance kTolerance{.relative = 1e-6, .floor = 1e-9};
constexpr std::size_t kSections = 100;

void add_state(States& states, double x, double y, double vx, double vy) {
  states.insert(states.end(), {x, y, vx, vy});
}

/// `period` states all over a ball of 10 mm, repeated, each with an error of up to `noise` [m] per component.
States periodic(std::size_t period, double noise = 0.0, std::size_t sections = kSections) {
  std::mt19937 random(static_cast<unsigned>(period));
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  States cycle(kStateSize * period);
  for (auto& value : cycle) value = 1e-2 * uniform(random);
  States states;
  for (std::size_t i = 0; i < kStateSize * sections; ++i) {
    states.push_back(cycle[i % cycle.size()] + noise * uniform(random));
  }
  return states;
}

/// Points on a circle, each turned by `turn` revolutions against the one before.
States rotation(double turn, std::size_t sections = kSections) {
  States states;
  for (std::size_t i = 0; i < sections; ++i) {
    const double angle = 2.0 * std::numbers::pi * turn * static_cast<double>(i);
    add_state(states, 1e-2 * std::cos(angle), 1e-2 * std::sin(angle), -1e-2 * std::sin(angle),
              1e-2 * std::cos(angle));
  }
  return states;
}

/// Logistic map at full chaos, as the x of a motion.
States chaotic(std::size_t sections = kSections) {
  States states;
  double value = 0.3141;
  for (std::size_t i = 0; i < sections; ++i) {
    value = 4.0 * value * (1.0 - value);
    add_state(states, 1e-2 * value, 1e-3, 0.0, 0.0);
  }
  return states;
}

TEST(Class, FindsEveryPeriodFromOneToSixteen) {
  for (std::size_t period = 1; period <= 16; ++period) {
    EXPECT_EQ(classify(periodic(period), kTolerance), period);
  }
}

TEST(Class, CallsPeriodSeventeenAperiodic) {
  EXPECT_EQ(classify(periodic(17), kTolerance), motion_class::kAperiodic);
}

TEST(Class, ForgivesNoiseBelowTheToleranceOnly) {
  // Two states differ by at most 2 · 2 · noise (four components), the orbit is about 1.5e-2 m large.
  EXPECT_EQ(classify(periodic(3, 1e-9), kTolerance), 3);
  EXPECT_EQ(classify(periodic(3, 1e-7), kTolerance), motion_class::kUnresolved);
  EXPECT_EQ(classify(periodic(3, 1e-5), kTolerance), motion_class::kAperiodic);
}

TEST(Class, CallsAQuasiPeriodicRotationAperiodic) {
  EXPECT_EQ(classify(rotation(std::numbers::sqrt2), kTolerance), motion_class::kAperiodic);
  EXPECT_EQ(classify(rotation(0.3), kTolerance), 10);
}

TEST(Class, CallsChaosAperiodic) {
  EXPECT_EQ(classify(chaotic(), kTolerance), motion_class::kAperiodic);
}

TEST(Class, CallsAMotionThatStillConvergesUnresolved) {
  // From 1e-4 m off the fixed point, shrinking by a tenth per section: the first half is far, the second
  // close.
  States states;
  for (std::size_t i = 0; i < kSections; ++i) {
    const double off = 1e-4 * std::pow(0.7, static_cast<double>(i));
    add_state(states, 1e-2 + off, 0.0, 0.0, 5e-3);
  }
  EXPECT_EQ(classify(states, kTolerance), motion_class::kUnresolved);
}

TEST(Class, CallsAMotionThatChangesHalfWayUnresolved) {
  States states = periodic(2, 0.0, 50);
  const States second = periodic(4, 0.0, 50);
  states.insert(states.end(), second.begin(), second.end());
  EXPECT_EQ(classify(states, kTolerance), motion_class::kUnresolved);

  States jump = periodic(1, 0.0, 50);  // both halves period 1, at different places
  for (std::size_t i = 0; i < 50; ++i) add_state(jump, 3e-3, 0.0, 0.0, 0.0);
  EXPECT_EQ(classify(jump, kTolerance), motion_class::kUnresolved);

  States burst = periodic(1, 0.0, 50);
  const States chaos = chaotic(50);
  burst.insert(burst.end(), chaos.begin(), chaos.end());
  EXPECT_EQ(classify(burst, kTolerance), motion_class::kUnresolved);
}

TEST(Class, CallsAShaftAtRestPeriodOne) {
  EXPECT_EQ(classify(States(kStateSize * kSections, 0.0), kTolerance), 1);
  EXPECT_EQ(classify(States(kStateSize * kSections, 0.0), {.relative = 1e-6, .floor = 0.0}), 1);
}

TEST(Class, DoesNotSeeMotionBelowTheFloor) {
  States states;
  for (std::size_t i = 0; i < kSections; ++i) add_state(states, i % 2 == 0 ? 4e-10 : -4e-10, 0.0, 0.0, 0.0);
  EXPECT_EQ(classify(states, kTolerance), 1);
  EXPECT_EQ(classify(states, {.relative = 1e-6, .floor = 0.0}), 2);
}

TEST(Class, ComparesVelocitiesAsWellAsPositions) {
  States states;
  for (std::size_t i = 0; i < kSections; ++i) add_state(states, 1e-2, 0.0, 0.0, i % 2 == 0 ? 1e-3 : -1e-3);
  EXPECT_EQ(classify(states, kTolerance), 2);
}

TEST(Class, IsTheSameForARotatedOrbit) {
  for (const auto& states : {periodic(5), periodic(3, 1e-7), chaotic()}) {
    States rotated;
    const double c = std::cos(1.0);
    const double s = std::sin(1.0);
    for (std::size_t i = 0; i < states.size(); i += kStateSize) {
      add_state(rotated, c * states[i] - s * states[i + 1], s * states[i] + c * states[i + 1],
                c * states[i + 2] - s * states[i + 3], s * states[i + 2] + c * states[i + 3]);
    }
    EXPECT_EQ(classify(rotated, kTolerance), classify(states, kTolerance));
    EXPECT_NEAR(orbit_size(rotated), orbit_size(states), 1e-16);
  }
}

TEST(Class, IsTheSameForAScaledOrbitAndFloor) {
  for (const auto& states : {periodic(5), periodic(3, 1e-7), chaotic()}) {
    States scaled = states;
    for (auto& value : scaled) value *= 1024.0;
    EXPECT_EQ(classify(scaled, {.relative = 1e-6, .floor = 1024.0 * 1e-9}), classify(states, kTolerance));
  }
}

TEST(Class, OfAPeriodicOrbitDoesNotDependOnWhereTheRecordStarts) {
  const States states = periodic(6, 0.0, kSections + 6);
  for (std::size_t shift = 0; shift < 6; ++shift) {
    EXPECT_EQ(classify(std::span(states).subspan(kStateSize * shift, kStateSize * kSections), kTolerance), 6);
  }
}

TEST(Class, NeverDeniesPeriodsThatTheRecordIsTooShortToSee) {
  EXPECT_EQ(classify(chaotic(34), kTolerance), motion_class::kAperiodic);
  EXPECT_EQ(classify(chaotic(33), kTolerance), motion_class::kUnresolved);
  EXPECT_EQ(classify(periodic(8, 0.0, 20), kTolerance), 8);
  EXPECT_EQ(classify(periodic(12, 0.0, 20), kTolerance), motion_class::kUnresolved);
  EXPECT_EQ(classify(periodic(1, 0.0, 4), kTolerance), 1);
  EXPECT_EQ(classify(periodic(1, 0.0, 3), kTolerance), motion_class::kUnresolved);
}

TEST(Class, IsNoneWithoutDataOrWithAValueThatIsNotFinite) {
  EXPECT_EQ(classify({}, kTolerance), motion_class::kNone);
  States states = periodic(2);
  states[17] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(classify(states, kTolerance), motion_class::kNone);
  states[17] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(classify(states, kTolerance), motion_class::kNone);
}

TEST(ClosingDistance, IsTheLargestOverTheRecord) {
  States states(kStateSize * 5, 0.0);
  states[4 * 4 + 1] = 3.0;
  states[4 * 4 + 2] = 4.0;
  EXPECT_DOUBLE_EQ(closing_distance(states, 1), 5.0);
  EXPECT_DOUBLE_EQ(closing_distance(std::span(states).first(16), 1), 0.0);
}

}  // namespace
}  // namespace rubatlas::analysis

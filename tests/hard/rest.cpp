/// Tips at rest, searched: whether a tip rests, turns round or comes loose depends neither on the steps nor
/// on the last digits of a motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "../support/point.hpp"

namespace rubatlas::test {
namespace {

/// A kick against the spin, as slow rotors need it for a tip to come to rest.
struct Start {
  settings::Scene scene;
  double speed_ratio;
  motion::SectionState state;
};

Start random_start(std::uint64_t seed, bool sticks) {
  std::mt19937_64 bits(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(bits() >> 11U) * 0x1p-53;
  };
  Start start{default_rotor(1), uniform(0.03, 0.6), {}};
  settings::Scene& scene = start.scene;
  scene.contact.friction = uniform(0.2, 0.8);
  scene.rotor.damping_ratio = uniform(0.02, 0.3);
  scene.rotor.misalignment = uniform(0.0, 0.012);
  scene.blades.count = 1 + static_cast<int>(uniform(0.0, 8.0));
  scene.blades.thickness = uniform(0.0008, 0.0016);
  if (sticks) scene.stick.emplace();
  for (std::size_t i = 0; i < 2; ++i) start.state[i] = uniform(-0.005, 0.005);
  for (std::size_t i = 2; i < 4; ++i) start.state[i] = uniform(-0.04, 0.04);
  return start;
}

/// How far tips at rest have been met, and where their motion was another one at another tolerance.
struct Found {
  int resting = 0;
  std::string differing;
};

/// Compares the motion at other tolerances with the one at the finest. `growth`: of a shift of the start, by
/// which errors grow too.
void look_at(std::uint64_t seed, bool sticks, Found& found) {
  const Start start = random_start(seed, sticks);
  settings::Scene scene = start.scene;
  const double clearance = scene.clearance();
  const auto at = [&](double tolerance, double shift) {
    scene.accuracy.tolerance = tolerance;
    motion::SectionState state = start.state;
    state[0] += shift * clearance;
    return run(scene, start.speed_ratio, state);
  };
  const auto finest = at(1e-12, 0.0);
  const auto& work = finest.work;
  if ((sticks ? work.slip_reversals : work.slip_accumulations) == 0) return;
  double growth = 1.0;
  for (const double shift : {1e-10, -1e-10, 1e-9}) {
    const auto shifted = at(1e-12, shift);
    const double apart = largest_difference(shifted.final_state, finest.final_state) / clearance;
    constexpr double kChaotic = 1e5;
    if (shifted.status != finest.status || !(apart <= kChaotic * std::abs(shift))) return;
    growth = std::max(growth, apart / std::abs(shift));
  }
  ++found.resting;
  for (const double tolerance : {1e-8, 1e-9, 1e-10, 1e-11}) {
    const auto outcome = at(tolerance, 0.0);
    const double apart = largest_difference(outcome.final_state, finest.final_state) / clearance;
    // Errors of some hundred steps and events add up, and each grows.
    constexpr double kSteps = 1e3;
    const bool same = outcome.detail == finest.detail && apart <= kSteps * growth * tolerance;
    if (!same)
      found.differing += std::to_string(seed) + " at " + std::to_string(std::log10(tolerance)) + ", ";
  }
}

void expect_the_same_at_every_tolerance(bool sticks, std::uint64_t starts) {
  Found found;
  for (std::uint64_t seed = 1; seed <= starts; ++seed) look_at(seed, sticks, found);
  EXPECT_EQ(found.differing, "") << "seeds, and logarithms of the tolerance";
  EXPECT_GT(found.resting, static_cast<int>(starts) / 20) << "a search that meets no rest searches nothing";
}

TEST(Rest, WhereReversalsAccumulateIsTheSameAtFiveTolerances) {
  expect_the_same_at_every_tolerance(false, 80);
}
TEST(Rest, OfTipsThatMayStickIsTheSameAtFiveTolerances) {
  expect_the_same_at_every_tolerance(true, 80);
}
TEST(RestSlow, WhereReversalsAccumulateIsTheSameAtFiveTolerancesFromTwoThousandStarts) {
  expect_the_same_at_every_tolerance(false, 2000);
}
TEST(RestSlow, OfTipsThatMayStickIsTheSameAtFiveTolerancesFromTwoThousandStarts) {
  expect_the_same_at_every_tolerance(true, 2000);
}

TEST(Rest, OfOneTipLeavesAnotherToReverseItsSlipWhereItsVelocityIsZero) {
  // While blade 0 rests blade 1 slips against its v, as it does without a tip at rest.
  const Start start = random_start(113, false);
  settings::Scene scene = start.scene;
  scene.protocol.sampled_revolutions = 1;
  std::array<motion::SectionState, 2> ends{};
  for (std::size_t i = 0; i < 2; ++i) {
    scene.accuracy.tolerance = i == 0 ? 1e-8 : 1e-12;
    const auto outcome = run(scene, start.speed_ratio, start.state);
    EXPECT_GE(outcome.work.slip_accumulations, 2U);
    ends[i] = outcome.final_state;
  }
  EXPECT_LE(largest_difference(ends[0], ends[1]), 1e-5 * scene.clearance());
}

}  // namespace
}  // namespace rubatlas::test

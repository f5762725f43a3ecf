/// A million revolutions: nothing wears off, neither the phase of the section nor energy nor period.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../support/point.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;
using motion::SectionState;

/// The free rotor after a number of revolutions, ζ = 0: turned in the plane (z, z') by 2π N/Ω. The angle is
/// reduced in whole numbers of turns before it is rounded: Ω is a quotient of small whole numbers.
SectionState swung(const SectionState& start, long revolutions, long numerator, long denominator) {
  const long turns = revolutions * denominator % numerator;  // N/Ω modulo 1, in units of 1/numerator
  const double angle = 2.0 * std::numbers::pi * static_cast<double>(turns) / static_cast<double>(numerator);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {start[0] * c + start[2] * s, start[1] * c + start[3] * s, start[2] * c - start[0] * s,
          start[3] * c - start[1] * s};
}

double energy(const SectionState& state) {
  return state[0] * state[0] + state[1] * state[1] + state[2] * state[2] + state[3] * state[3];
}

void fly(int revolutions) {
  // An undamped rotor that swings within the clearance: period and energy are known exactly.
  settings::Scene scene = default_rotor(1);
  scene.rotor.damping_ratio = 0.0;
  scene.rotor.misalignment = 0.002;
  scene.protocol.transient_revolutions = revolutions - 1;
  const SectionState start{3e-3, -1e-3, 2e-3, 4e-3};
  struct Speed {
    long numerator, denominator;
  };
  for (const Speed speed : {Speed{7, 3}, Speed{5, 1}, Speed{3, 10}, Speed{97, 100}}) {
    const double ratio = static_cast<double>(speed.numerator) / static_cast<double>(speed.denominator);
    const auto outcome = run(scene, ratio, start);
    ASSERT_EQ(outcome.status, PointStatus::done);
    ASSERT_EQ(outcome.work.right_hand_sides, 0U);
    const double relative_energy = std::abs(energy(outcome.final_state) / energy(start) - 1.0);
    // Rounding at the end of each revolution, half a unit in the last place in each of four components; and
    // the rounding of 2π/Ω, the same each time.
    EXPECT_LE(relative_energy, 2.0 * revolutions * 2.2e-16) << ratio;
    const double phase_error =
        largest_difference(outcome.final_state,
                           swung(start, revolutions, speed.numerator, speed.denominator)) /
        5e-3;
    EXPECT_LE(phase_error, revolutions * (1.0 + 2.0 * std::numbers::pi / ratio) * 2.2e-16) << ratio;
  }
}

void rub(int revolutions) {
  // Orbits with three contacts in a revolution that repeat after each: once settled, every section is the
  // same to the last digits, and stays so.
  for (const auto law : {settings::ContactLaw::elastica, settings::ContactLaw::elastic_ring}) {
    settings::Scene scene = default_rotor(100);
    scene.contact.law = law;
    scene.protocol.transient_revolutions = 1000;
    scene.protocol.settle = settings::Settle::never;
    const double speed = 0.4;
    const auto early = run(scene, speed);
    ASSERT_EQ(early.status, PointStatus::done);
    scene.protocol.transient_revolutions = revolutions - 100;
    const auto late = run(scene, speed);
    ASSERT_EQ(late.status, PointStatus::done);
    EXPECT_GE(late.work.touchdowns, static_cast<std::uint64_t>(2 * revolutions));
    double drift = 0.0;
    for (std::size_t i = 0; i < early.rows[0].size(); ++i) {
      drift = std::max(drift, std::abs(early.rows[0][i] - late.rows[0][i]));
    }
    EXPECT_LE(drift, 1e-12 * scene.clearance());
    EXPECT_NEAR(early.rows[1][0], late.rows[1][0], 1e-12 * scene.clearance());
  }
}

TEST(LongRun, FreeFlightKeepsEnergyAndPhaseForFiftyThousandRevolutions) {
  fly(50'000);
}
TEST(LongRun, APeriodicOrbitKeepsItsPeriodForFiveThousandRevolutions) {
  rub(5'000);
}

TEST(LongRunSlow, FreeFlightKeepsEnergyAndPhaseForAMillionRevolutions) {
  fly(1'000'000);
}
TEST(LongRunSlow, APeriodicOrbitKeepsItsPeriodForAMillionRevolutions) {
  rub(1'000'000);
}

}  // namespace
}  // namespace rubatlas::test

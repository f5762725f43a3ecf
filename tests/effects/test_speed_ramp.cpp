// A speed that ramps: constant within a revolution, and nothing jumps between two.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "../settings/scene_error_text.hpp"
#include "assembly/make_line_solver.hpp"
#include "effect_scene.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;
using nlohmann::json;
using Complex = std::complex<double>;

json ramped(double rate, double speed, int transient, int sampled) {
  return {{"grid", {{"speed_ratio", speed}}},
          {"speed_ramp", {{"rate", rate}}},
          {"protocol", {{"transient_revolutions", transient}, {"sampled_revolutions", sampled}}},
          {"observables",
           {"poincare", "poincare_blade_passing", "max_displacement", "touchdowns_per_revolution",
            "max_contact_force", "contact_fraction"}},
          {"accuracy", {{"tolerance", 1e-12}}}};
}

TEST(SpeedRamp, InFlightAnUnbalancedRotorFollowsThePiecewiseClosedForm) {
  constexpr double kDamping = 0.07;
  constexpr double kMoment = 2e-4;
  constexpr double kPhase = 0.7;
  json content = ramped(0.02, 0.4, 3, 30);  // through resonance
  content["rotor"] = {{"misalignment", 0.0}, {"damping_ratio", kDamping}};
  content["unbalance"] = {{"moment", kMoment}, {"phase", kPhase}};
  content["accuracy"] = json::object();
  const auto outcome = run(parsed(content), {1e-3, 0.0, 0.0, -5e-4});
  ASSERT_EQ(outcome.status, PointStatus::done);
  ASSERT_EQ(outcome.work.touchdowns, 0U);

  Complex position(1e-3, 0.0);
  Complex velocity(0.0, -5e-4);
  const double damped = std::sqrt(1.0 - kDamping * kDamping);
  for (int revolution = 0; revolution < 33; ++revolution) {
    const double speed = 0.4 + 0.02 * std::max(0, revolution - 3);
    const double time = 2.0 * std::numbers::pi / speed;
    const Complex steady = kMoment * std::polar(1.0, kPhase) * speed * speed /
                           Complex(1.0 - speed * speed, 2.0 * kDamping * speed);
    const Complex aside = position - steady;
    const Complex rate = velocity - Complex(0.0, speed) * steady;
    const double cosine = std::cos(damped * time);
    const double sine = std::sin(damped * time) / damped;
    const double decay = std::exp(-kDamping * time);
    position = steady + decay * (aside * cosine + (rate + kDamping * aside) * sine);
    velocity = Complex(0.0, speed) * steady + decay * (rate * cosine - (kDamping * rate + aside) * sine);
    if (revolution < 3) continue;
    const auto section = static_cast<std::size_t>(4 * (revolution - 3));
    EXPECT_NEAR(outcome.rows[0][section], position.real(), 1e-15) << revolution;
    EXPECT_NEAR(outcome.rows[0][section + 1], position.imag(), 1e-15) << revolution;
    EXPECT_NEAR(outcome.rows[0][section + 2], velocity.real(), 1e-15) << revolution;
    EXPECT_NEAR(outcome.rows[0][section + 3], velocity.imag(), 1e-15) << revolution;
  }
}

TEST(SpeedRamp, ARunUpIsItsRevolutionsOneByOne) {
  constexpr double kRate = 0.004;
  constexpr int kTransient = 2;
  constexpr int kSampled = 6;
  json content = ramped(kRate, 0.44, kTransient, kSampled);
  content["unbalance"] = {{"moment", 1e-4}, {"phase", 0.3}};
  const auto whole = run(parsed(content));
  ASSERT_EQ(whole.status, PointStatus::done);

  content.erase("speed_ramp");
  content["protocol"] = {{"transient_revolutions", 0}, {"sampled_revolutions", 1}};
  motion::SectionState state{};
  double time = 0.0;
  double in_contact = 0.0;
  double touchdowns = 0.0;
  double displacement = 0.0;
  double force = 0.0;
  constexpr double kClose = 1e-9;  // m: the errors of steps grow with the motion
  for (int revolution = 0; revolution < kTransient + kSampled; ++revolution) {
    const int sampled = revolution - kTransient;
    const double speed = 0.44 + kRate * std::max(0, sampled);
    content["grid"]["speed_ratio"] = speed;
    const auto single = run(parsed(content), state);
    ASSERT_EQ(single.status, PointStatus::done);
    state = single.final_state;
    if (sampled < 0) continue;
    const auto section = static_cast<std::size_t>(sampled);
    EXPECT_LE(largest_difference(whole.rows[0], single.rows[0], 4 * section), kClose) << sampled;
    for (std::size_t i = 0; i < 12; ++i) {
      EXPECT_NEAR(whole.rows[1][12 * section + i], single.rows[1][i], kClose) << sampled;
    }
    displacement = std::max(displacement, single.rows[2][0]);
    touchdowns += single.rows[3][0];
    force = std::max(force, single.rows[4][0]);
    time += 1.0 / speed;
    in_contact += single.rows[5][0] / speed;
  }
  EXPECT_LE(largest_difference(whole.final_state, state), kClose);
  EXPECT_NEAR(whole.rows[2][0], displacement, kClose);
  EXPECT_GT(touchdowns, 0.0);
  EXPECT_EQ(whole.rows[3][0], touchdowns / kSampled);
  EXPECT_NEAR(whole.rows[4][0], force, 1e-4);
  EXPECT_NEAR(whole.rows[5][0], in_contact / time, 1e-6);
}

/// A blade of four stands at the top, where the shaft is nearest to the ring, at each section: so soft that
/// it does not throw the shaft away before.
json touching_at_sections(const std::string& law) {
  json content = ramped(0.0, 0.3, 0, 5);
  content.erase("speed_ramp");
  content["blades"] = {{"count", 4}, {"youngs_modulus", 2e7}};
  content["rotor"]["misalignment"] = 0.0105;
  content["contact"]["law"] = law;
  if (law == "elastic_ring") content["ring"]["stiffness"] = 10.0;
  content["observables"] = {"poincare", "touchdowns_per_revolution"};
  return content;
}

TEST(SpeedRamp, ABladeInContactStaysSoWhileSpeedOrLengthChanges) {
  for (const char* law : {"elastica", "elastic_ring"}) {
    SCOPED_TRACE(law);
    const json content = touching_at_sections(law);
    const auto plain = run(parsed(content));
    ASSERT_EQ(plain.status, PointStatus::done);
    const settings::Scene scene = parsed(content);
    int touching = 0;
    for (std::size_t at = 0; at < plain.rows[0].size(); at += 4) {
      const double top = plain.rows[0][at + 1] + scene.rotor.misalignment + scene.blades.length;
      if (std::hypot(plain.rows[0][at], top) > scene.ring.radius) ++touching;
    }
    EXPECT_GT(touching, 2) << "or nothing is tested";
    for (const char* section : {"speed_ramp", "wear"}) {
      SCOPED_TRACE(section);
      json changing = content;
      changing[section]["rate"] = 1e-13;  // enough to hand over at each section, and to change nothing
      const auto outcome = run(parsed(changing));
      ASSERT_EQ(outcome.status, PointStatus::done);
      EXPECT_EQ(outcome.rows[1], plain.rows[1]) << "touch-downs";
      EXPECT_LE(largest_difference(outcome.rows[0], plain.rows[0]), 1e-10);
    }
  }
}

TEST(SpeedRamp, AnOrbitHasTheSectionsOfTheRunAndItsOwnClock) {
  json content = ramped(0.01, 0.44, 1, 3);
  content["protocol"]["samples_per_revolution"] = 16;
  const settings::Scene scene = parsed(content);
  const auto orbit = solver_of_first_line(scene)->orbit(0.44, motion::SectionState{});
  const auto outcome = run(scene);
  ASSERT_EQ(orbit.sections.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(orbit.sections[i][c], outcome.rows[0][4 * i + c]);
  }
  double begin = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double period = 2.0 * std::numbers::pi / (0.44 + 0.01 * static_cast<double>(i));
    EXPECT_NEAR(orbit.time[16 * i], begin, 1e-12);
    EXPECT_NEAR(orbit.time[16 * i + 8], begin + 0.5 * period, 1e-12);
    begin += period;
  }
}

TEST(SpeedRamp, MustNotLeadOutOfTheLegalSpeeds) {
  const auto refusal = [](double rate) { return settings::refusal(ramped(rate, 0.5, 0, 11).dump()); };
  EXPECT_EQ(refusal(-0.04), "accepted");
  EXPECT_EQ(refusal(-0.098).rfind("/speed_ramp/rate: from speed ratio 0.5 on -0.098 leads to -0.48 in the "
                                  "last sampled revolution; speed ratios are ",
                                  0),
            0U)
      << refusal(-0.098);
}

}  // namespace
}  // namespace rubatlas::test

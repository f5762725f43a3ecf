/// What one point promises: repeatable to the bit, bounded, honest about its end.
#include "point/line_solver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "../support/point.hpp"
#include "reference_case.hpp"

namespace rubatlas::test {
namespace {

using test::run;  // also where another source of this folder has a `run` of its own

constexpr motion::SectionState kRest{0.0, 0.0, 0.0, 0.0};

settings::Scene default_scene() {
  settings::Scene scene;
  scene.observables = observables_without_wear();
  scene.protocol = {20, 10, 64};
  return scene;
}

TEST(LineSolver, APointHasTheSameBitsWhateverRanBeforeIt) {
  const settings::Scene scene = default_scene();
  const auto solver = solver_of(scene);
  const auto fresh = solver->run(0.62, kRest);
  solver->run(0.75, kRest);
  solver->run(0.31, motion::SectionState{1e-3, 0.0, 0.0, 0.0});
  const auto again = solver->run(0.62, kRest);
  EXPECT_EQ(fresh.rows, again.rows);
  EXPECT_EQ(fresh.final_state, again.final_state);
  EXPECT_EQ(fresh.work.right_hand_sides, again.work.right_hand_sides);
}

TEST(LineSolver, ARotorThatCannotReachTheRingCostsNoIntegration) {
  settings::Scene scene = default_scene();
  scene.rotor.misalignment = 0.005;
  const auto outcome = run(scene, 0.5, {1e-3, 0.0, 0.0, 0.0});
  EXPECT_EQ(outcome.status, ending::PointStatus::done);
  EXPECT_EQ(outcome.work.right_hand_sides, 0U);
  EXPECT_LE(outcome.work.gap_evaluations, 30U) << "one bound per revolution";
}

TEST(LineSolver, UnbalanceWithoutContactCirclesWithTheTextbookAmplitude) {
  settings::Scene scene = default_scene();
  scene.rotor.misalignment = 0.0;
  scene.unbalance = settings::Unbalance{1e-3, 0.4};
  scene.observables = {"max_displacement", "spectrum"};
  scene.protocol = {60, 10, 64};
  const double speed = 0.8;
  const auto outcome = run(scene, speed);
  ASSERT_EQ(outcome.status, ending::PointStatus::done);
  const double exact = 1e-3 * speed * speed / std::hypot(1.0 - speed * speed, 2.0 * 0.1 * speed);
  EXPECT_NEAR(outcome.rows[0][0], exact,
              1e-13 * exact + 1e-3 * std::exp(-0.1 * 60 * 2 * std::numbers::pi / speed));
  EXPECT_NEAR(outcome.rows[1][10], exact, 1e-12) << "the 1x line of the spectrum, 0-peak";
}

TEST(LineSolver, AResonantUndampedRotorGrowsWithoutBoundUntilItLeavesTheModel) {
  settings::Scene scene = default_scene();
  scene.blades.count = 1;
  scene.rotor.damping_ratio = 0.0;
  scene.unbalance = settings::Unbalance{1e-2, 0.0};  // the one blade cannot hold it
  const auto outcome = run(scene, 1.0);
  EXPECT_EQ(outcome.status, ending::PointStatus::left_validity);
  EXPECT_GE(outcome.failed_revolution, 0);
}

TEST(LineSolver, ADeepMisalignmentEndsWithAStatusAndRowsOfNaN) {
  settings::Scene scene = default_scene();
  scene.rotor.misalignment = 0.06;  // 0.55 R: no root of the contact equation
  const auto outcome = run(scene, 0.3);
  EXPECT_EQ(outcome.status, ending::PointStatus::left_validity);
  EXPECT_EQ(outcome.failed_revolution, 0);
  EXPECT_TRUE(std::isnan(outcome.final_state[0]));
  for (const auto& row : outcome.rows) {
    for (const double value : row) EXPECT_TRUE(std::isnan(value));
  }
}

TEST(LineSolver, TheDefaultRotorStaysWithinTheModelAt0_90AndLeavesItAt1_20) {
  // Between, motions from rest are chaotic and graze the model's border: whether and when one leaves hangs on
  // the last digits (within 300 revolutions one in 150 at 0.95, one in twenty at 0.98; MODEL 5).
  settings::Scene scene = default_scene();
  scene.protocol = {200, 100, 64};
  scene.observables = {"max_displacement"};
  for (const double tolerance : {1e-8, 1e-9, 1e-10}) {
    scene.accuracy.tolerance = tolerance;
    EXPECT_EQ(run(scene, 0.90).status, ending::PointStatus::done) << "tolerance " << tolerance;
    EXPECT_EQ(run(scene, 1.20).status, ending::PointStatus::left_validity) << "tolerance " << tolerance;
  }
}

TEST(LineSolver, LimitOfVanishingFrictionIsTheFrictionlessRotor) {
  // MODEL 4.6, to the digits given there.
  const std::vector<std::pair<double, double>> published = {
      {1e-3, 0.0153740}, {1e-4, 0.0154506}, {1e-5, 0.0154589}, {0.0, 0.0154598}};
  for (const auto& [friction, displacement] : published) {
    settings::Scene scene = default_scene();
    scene.contact.friction = friction;
    scene.observables = {"max_displacement"};
    scene.protocol = {200, 100, 64};
    EXPECT_NEAR(run(scene, 0.62).rows[0][0], displacement, 6e-8) << "friction " << friction;
  }
}

TEST(LineSolver, TheOrbitPassesThroughThePoincareSections) {
  settings::Scene scene = default_scene();
  scene.protocol.settle = settings::Settle::never;
  const auto solver = solver_of(scene);
  const auto outcome = solver->run(0.62, kRest);
  const auto orbit = solver->orbit(0.62, kRest);
  ASSERT_EQ(orbit.time.size(), 10U * 64U);
  ASSERT_EQ(orbit.force.size(), 3U * orbit.time.size());
  ASSERT_EQ(orbit.sections.size(), 10U);
  for (std::size_t i = 0; i < 10; ++i) {
    for (std::size_t component = 0; component < 4; ++component) {
      EXPECT_EQ(orbit.sections[i][component], outcome.rows[0][4 * i + component]);
    }
  }
  for (std::size_t i = 1; i < 10; ++i) {
    EXPECT_LE(largest_difference(orbit.state[64 * i], orbit.sections[i - 1]), 1e-15)
        << "each revolution starts at a section";
  }
}

TEST(LineSolver, TheLargestForceIsThatOfADenseScan) {
  for (const double speed : {0.62, 0.9}) {
    settings::Scene scene = default_scene();
    scene.protocol = {20, 10, 20000};
    scene.observables = {"max_contact_force"};
    const auto solver = solver_of(scene);
    const double largest = solver->run(speed, kRest).rows[0][0];
    const auto orbit = solver->orbit(speed, kRest);
    const double scanned = *std::max_element(orbit.force.begin(), orbit.force.end());
    EXPECT_GE(largest, scanned * (1.0 - 1e-12));
    EXPECT_NEAR(largest, scanned, 1e-4 * scanned) << "the scan misses the peak by less than a sample";
  }
}

TEST(LineSolver, SlipThatReversesOnARigidBladeGoesOnReversed) {
  // Without an elastic tip v does not jump at a reversal, and starts the next phase at zero to rounding. At
  // low damping a rotor that whirls backwards in the ring goes on doing so, and slip reverses in each
  // contact.
  settings::Scene scene = default_scene();
  scene.contact.law = settings::ContactLaw::elastic_ring;
  scene.rotor.damping_ratio = 0.01;
  scene.observables = {"touchdowns_per_revolution"};
  scene.protocol = {20, 10, 64};
  for (const double speed :
       {0.4559322033898305, 0.5101694915254237, 0.5372881355932203, 0.5779661016949152}) {
    const auto outcome = run(scene, speed, {0.012, 0.0, 0.0, -0.1});
    EXPECT_EQ(outcome.status, ending::PointStatus::done) << "speed ratio " << speed;
    EXPECT_GT(outcome.work.slip_reversals, outcome.work.touchdowns / 4);
    EXPECT_LT(outcome.work.slip_reversals, 2 * outcome.work.touchdowns);
  }
}

TEST(LineSolver, BladesStrainedBeyondYieldAreFlaggedAndRunOn) {
  settings::Scene scene = default_scene();
  scene.observables = {"max_root_strain"};
  const auto unflagged = run(scene, 0.62);
  ASSERT_EQ(unflagged.rows.size(), 1U) << "no limit, no flag";
  const double strain = unflagged.rows[0][0];
  for (const bool beyond : {true, false}) {
    scene.validity.yield_strain = strain * (beyond ? 0.9 : 1.1);
    const auto flagged = run(scene, 0.62);
    EXPECT_EQ(flagged.status, ending::PointStatus::done);
    ASSERT_EQ(flagged.rows.size(), 2U);
    EXPECT_EQ(flagged.rows[1][0], beyond ? 1.0 : 0.0);
  }
}

TEST(LineSolver, WhatIsObservedNeverChangesTheMotion) {
  // Ten blades: several touch at once, where each force is found from a first guess.
  settings::Scene scene = default_scene();
  scene.blades.count = 10;
  scene.protocol = {5, 5, 256};
  const auto all = run(scene, 0.9);
  scene.observables = {"poincare"};
  const auto sections_alone = run(scene, 0.9);
  ASSERT_EQ(all.status, ending::PointStatus::done);
  EXPECT_EQ(all.rows[0], sections_alone.rows[0]);
  EXPECT_EQ(all.final_state, sections_alone.final_state);
}

TEST(LineSolver, TheLastBladePassingOfARevolutionIsItsSection) {
  const auto outcome = run(default_scene(), 0.62);
  for (std::size_t i = 0; i < 10; ++i) {
    for (std::size_t component = 0; component < 4; ++component) {
      EXPECT_EQ(outcome.rows[1][4 * (3 * i + 2) + component], outcome.rows[0][4 * i + component]);
    }
  }
}

TEST(LineSolver, AMotionThatBeginsAtNoPlaceEndsAtOnceUnderEveryLaw) {
  settings::Scene regularised = default_scene();
  regularised.regularised_friction = effects::RegularisedFriction{.velocity = 0.1};
  settings::Scene rigid = default_scene();
  rigid.contact.law = settings::ContactLaw::elastic_ring;
  for (const settings::Scene& scene : {default_scene(), regularised, rigid}) {
    const auto outcome = run(scene, 0.62, {0.0, std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0});
    EXPECT_EQ(outcome.status, ending::PointStatus::integrator_failed);
    EXPECT_EQ(outcome.failed_revolution, 0);
  }
}

TEST(LineSolver, AsksAfterEachRevolutionWhetherToGoOn) {
  settings::Scene scene = default_scene();
  scene.protocol.settle = settings::Settle::never;
  const auto solver = solver_of(scene);
  int calls = 0;
  const auto whole = solver->run(0.4, kRest, [&] { return ++calls > 0; });
  EXPECT_GE(calls, 30) << "and every few milliseconds within one";
  EXPECT_EQ(whole.status, ending::PointStatus::done);
  calls = 0;
  const auto given_up = solver->run(0.4, kRest, [&] { return ++calls < 5; });
  EXPECT_EQ(calls, 5);
  EXPECT_EQ(given_up.status, ending::PointStatus::pending);
}

}  // namespace
}  // namespace rubatlas::test

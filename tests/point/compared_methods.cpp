/// The methods that the hybrid one is compared with: each reaches the reference orbits
/// (tests/reference), and its error falls with its own knob as far as theory says.
///
/// Measured figures stand beside the bounds. Errors are the largest difference of a section's components,
/// relative to the clearance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "../support/point.hpp"
#include "reference_case.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;
using point::PointOutcome;
using settings::Method;

settings::Accuracy fixed_steps(double step) {
  settings::Accuracy accuracy;
  accuracy.method = Method::fixed;
  accuracy.step = step;
  return accuracy;
}
settings::Accuracy located_events(double tolerance) {
  settings::Accuracy accuracy;
  accuracy.method = Method::located;
  accuracy.tolerance = tolerance;
  return accuracy;
}
settings::Accuracy published(double tolerance, double force_increment) {
  settings::Accuracy accuracy;
  accuracy.method = Method::paper;
  accuracy.tolerance = tolerance;
  accuracy.force_increment = force_increment;
  return accuracy;
}
settings::Accuracy hybrid(double tolerance) {
  settings::Accuracy accuracy;
  accuracy.tolerance = tolerance;
  return accuracy;
}

PointOutcome run(settings::Scene scene, const ReferenceCase& c, const settings::Accuracy& accuracy,
                 int revolutions) {
  scene.accuracy = accuracy;
  scene.observables = {"poincare"};
  scene.protocol = {0, revolutions, 64};
  return test::run(scene, c.speed_ratio, c.start);
}

motion::SectionState section(const PointOutcome& outcome, std::size_t number) {
  const auto& row = outcome.rows.at(0);
  return {row.at(4 * number), row.at(4 * number + 1), row.at(4 * number + 2), row.at(4 * number + 3)};
}

/// Over the first four revolutions.
double early_error(const ReferenceCase& c, const settings::Accuracy& accuracy) {
  constexpr int kRevolutions = 4;
  const PointOutcome outcome = run(c.scene, c, accuracy, kRevolutions);
  EXPECT_EQ(outcome.status, PointStatus::done) << c.name;
  double largest = 0.0;
  for (std::size_t i = 0; i < kRevolutions; ++i) {
    largest = std::max(largest, largest_difference(section(outcome, i), c.first_sections[i]));
  }
  return largest / c.scene.clearance();
}

/// At the end of all revolutions, on a periodic motion.
double late_error(const ReferenceCase& c, const settings::Accuracy& accuracy) {
  const PointOutcome outcome = run(c.scene, c, accuracy, c.last_section);
  EXPECT_EQ(outcome.status, PointStatus::done) << c.name;
  double largest = 0.0;
  for (std::size_t i = 0; i < c.last_sections.size(); ++i) {
    const std::size_t number = static_cast<std::size_t>(c.last_section) - 11 + i;
    largest = std::max(largest, largest_difference(section(outcome, number), c.last_sections[i]));
  }
  return largest / c.scene.clearance();
}

/// Slope of log(error) over log(knob), by least squares.
double slope(const std::vector<std::pair<double, double>>& errors) {
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [knob, error] : errors) {
    x += std::log(knob);
    y += std::log(error);
    xx += std::log(knob) * std::log(knob);
    xy += std::log(knob) * std::log(error);
  }
  const auto n = static_cast<double>(errors.size());
  return (n * xy - x * y) / (n * xx - x * x);
}

/// A rotor that swings freely, too far from the ring to touch it, driven by its unbalance.
ReferenceCase free_rotor() {
  ReferenceCase c = reference_case("me1e-4_Om0.3");
  c.scene.rotor.misalignment = 0.0;
  c.start = {2e-3, -1e-3, 0.0, 3e-3};
  return c;
}

TEST(FixedMethod, ErrorInFlightFallsWithTheFourthPowerOfTheStep) {
  const ReferenceCase c = free_rotor();
  const auto exact = run(c.scene, c, hybrid(1e-12), 3).final_state;
  std::vector<std::pair<double, double>> errors;
  for (const double step : {0.2, 0.1, 0.05, 0.025}) {
    errors.emplace_back(step, largest_difference(run(c.scene, c, fixed_steps(step), 3).final_state, exact));
  }
  EXPECT_NEAR(slope(errors), 4.0, 0.2);
  EXPECT_LT(errors.back().second, 1e-8 * c.scene.clearance());
}

TEST(FixedMethod, TakesTheSameWholeNumberOfStepsInEachRevolution) {
  const ReferenceCase c = free_rotor();
  const double period = constants_of(c).period();
  const PointOutcome outcome = run(c.scene, c, fixed_steps(0.1), 7);
  EXPECT_EQ(outcome.work.steps, 7 * static_cast<std::uint64_t>(std::ceil(period / 0.1)));
  EXPECT_EQ(outcome.work.rejected_steps, 0u);
  EXPECT_EQ(outcome.work.right_hand_sides, 4 * outcome.work.steps + 1);
  EXPECT_EQ(outcome.work.elastica_evaluations, 0u) << "nothing touches";
}

TEST(FixedMethod, TouchDownsWithinAStepTakeTheOrderAway) {
  // The force of a step that holds a touch-down or lift-off is not smooth: a kink costs order two, a jump
  // (receding side, MODEL 4.2) order one, with a chance factor from where the event falls in its step, which
  // the mean over all reference motions evens out. Measured: 1.8, from 1.5e-3 at a step of 0.01 to 9e-6
  // at 6e-4.
  std::vector<std::pair<double, double>> errors;
  for (const double step : {1e-2, 5e-3, 2.5e-3, 1.25e-3, 6.25e-4}) {
    double logarithms = 0.0;
    int cases = 0;
    for (const ReferenceCase& c : reference_cases()) {
      if (!c.periodic) continue;
      logarithms += std::log(early_error(c, fixed_steps(step)));
      ++cases;
    }
    errors.emplace_back(step, std::exp(logarithms / cases));
  }
  EXPECT_GT(slope(errors), 1.0);
  EXPECT_LT(slope(errors), 2.5);
}

TEST(LocatedMethod, ErrorInFlightFollowsTheTolerance) {
  ReferenceCase c = free_rotor();
  settings::Accuracy accuracy = located_events(1e-6);
  accuracy.max_step = 1e3;
  const auto exact = run(c.scene, c, hybrid(1e-12), 3).final_state;
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    accuracy.tolerance = tolerance;
    const double error =
        largest_difference(run(c.scene, c, accuracy, 3).final_state, exact) / c.scene.clearance();
    EXPECT_LT(error, 10.0 * tolerance) << tolerance;
    EXPECT_GT(error, 1e-3 * tolerance) << "no work beyond what was asked for, at " << tolerance;
  }
}

class PeriodicMotion : public ::testing::TestWithParam<const char*> {};

TEST_P(PeriodicMotion, ErrorOfLocatedFollowsTheTolerance) {
  // The force starts like a root of the time (MODEL 3.3), which no error estimate of a polynomial formula
  // sees whole. Measured: errors of 0.4 to 124 tolerances.
  const ReferenceCase& c = reference_case(GetParam());
  ASSERT_TRUE(c.periodic);
  std::vector<std::pair<double, double>> errors;
  for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
    errors.emplace_back(tolerance, late_error(c, located_events(tolerance)));
    EXPECT_LE(errors.back().second, 300.0 * tolerance) << tolerance;
  }
  EXPECT_GT(slope(errors), 0.6);
}

TEST_P(PeriodicMotion, EveryMethodFindsTheTouchDownsOfTheReference) {
  const ReferenceCase& c = reference_case(GetParam());
  for (const auto& accuracy : {hybrid(1e-9), located_events(1e-8), fixed_steps(1e-3), published(1e-6, 0.1)}) {
    const PointOutcome outcome = run(c.scene, c, accuracy, 10);
    EXPECT_EQ(outcome.work.touchdowns, static_cast<std::uint64_t>(c.touchdowns_in_ten))
        << static_cast<int>(accuracy.method);
  }
}

INSTANTIATE_TEST_SUITE_P(Orbits, PeriodicMotion,
                         ::testing::Values("default_Om0.25", "default_Om0.40", "default_Om0.62",
                                           "me1e-5_Om0.62", "mu0_Om0.62", "mu0.5_Om0.62", "zeta1.5_Om0.5",
                                           "rig_mu0.1_Om0.605"),
                         [](const ::testing::TestParamInfo<const char*>& instance) {
                           std::string name = instance.param;
                           for (char& letter : name) {
                             if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
                           }
                           return name;
                         });

TEST(PaperMethod, ErrorFallsWithTheForceIncrement) {
  // Upward stepping ends up to dF above the root: order one. Measured over ten revolutions at Ω = 0.62:
  // 1.5e-1, 1.1e-2, 1.0e-3 and 9e-5 at dF = 10, 1, 0.1 and 0.01 N.
  for (const char* name : {"default_Om0.62", "default_Om0.25"}) {
    std::vector<std::pair<double, double>> errors;
    for (const double increment : {10.0, 1.0, 0.1}) {
      errors.emplace_back(increment, early_error(reference_case(name), published(1e-7, increment)));
    }
    EXPECT_NEAR(slope(errors), 1.0, 0.25) << name;
  }
}

TEST(PaperMethod, ToleranceAloneDoesNotRemoveTheErrorOfTheIncrement) {
  const ReferenceCase& c = reference_case("default_Om0.62");
  EXPECT_GT(early_error(c, published(1e-9, 1.0)), 1e-3) << "against 1e-9 asked for";
}

TEST(StepLimit, ErrorControlAloneStepsOverEveryContact) {
  // A rotor at rest is an exact solution of the equations of flight: a step of any length has no error, and
  // the blades that pass the ring meanwhile are not seen. Only a limit of the step finds them.
  ReferenceCase c = reference_case("default_Om0.25");
  c.start = {};
  settings::Accuracy unlimited = located_events(1e-12);
  unlimited.max_step = 1e3;
  const PointOutcome blind = run(c.scene, c, unlimited, 10);
  EXPECT_EQ(blind.work.touchdowns, 0u);
  EXPECT_EQ(blind.final_state, motion::SectionState{});
  EXPECT_GE(run(c.scene, c, located_events(1e-12), 10).work.touchdowns, 10u);
}

TEST(StepLimit, NoStepIsLonger) {
  const ReferenceCase c = free_rotor();
  const double period = constants_of(c).period();
  for (const double limit : {0.02, 0.1}) {
    for (settings::Accuracy accuracy : {located_events(1e-2), published(1e-2, 1.0)}) {
      accuracy.max_step = limit;
      const PointOutcome outcome = run(c.scene, c, accuracy, 4);
      EXPECT_GE(static_cast<double>(outcome.work.steps), 4.0 * period / limit);
      EXPECT_LE(static_cast<double>(outcome.work.steps), 4.0 * (period / limit + 3.0));
    }
  }
}

/// Every compared method at a setting that is good for three digits of a motion with hard contacts.
class EveryMethod : public ::testing::TestWithParam<Method> {
 protected:
  static settings::Accuracy good_setting() {
    switch (GetParam()) {
      case Method::fixed:
        return fixed_steps(5e-4);
      case Method::paper:
        return published(1e-6, 0.02);
      default:
        return located_events(1e-7);
    }
  }
};

TEST_P(EveryMethod, AgreesWithHybridUnderBothLawsWithUnbalance) {
  ReferenceCase c = reference_case("me1e-5_Om0.62");
  for (const auto law : {settings::ContactLaw::elastica, settings::ContactLaw::elastic_ring}) {
    c.scene.contact.law = law;
    const PointOutcome reference = run(c.scene, c, hybrid(1e-11), 5);
    const PointOutcome outcome = run(c.scene, c, good_setting(), 5);
    ASSERT_EQ(outcome.status, PointStatus::done);
    EXPECT_GE(outcome.work.touchdowns, 10u) << "three a revolution";
    EXPECT_LT(largest_difference(outcome.final_state, reference.final_state), 2e-3 * c.scene.clearance())
        << static_cast<int>(law);
  }
}

TEST_P(EveryMethod, FollowsSeveralBladesThatTouchAtOnce) {
  ReferenceCase c = reference_case("zeta1.5_Om0.5");  // damped: errors are not amplified
  c.scene.blades.count = 24;
  c.scene.blades.thickness = 0.0005;
  c.scene.rotor.misalignment = 0.0125;  // a quarter deeper than the clearance
  const PointOutcome reference = run(c.scene, c, hybrid(1e-11), 3);
  const PointOutcome outcome = run(c.scene, c, good_setting(), 3);
  ASSERT_EQ(outcome.status, PointStatus::done);
  EXPECT_EQ(outcome.work.touchdowns, reference.work.touchdowns);
  EXPECT_LT(largest_difference(outcome.final_state, reference.final_state), 1e-3 * c.scene.clearance());

  settings::Scene scene = c.scene;
  scene.accuracy = good_setting();
  scene.protocol = {0, 1, 256};
  const point::Orbit orbit = solver_of(scene)->orbit(c.speed_ratio, c.start);
  std::ptrdiff_t most = 0;
  for (auto first = orbit.force.begin(); first != orbit.force.end(); first += 24) {
    most = std::max(most, std::count_if(first, first + 24, [](double force) { return force > 0.0; }));
  }
  EXPECT_GE(most, 2) << "the case has what its name says";
}

TEST_P(EveryMethod, SaysWhenTheMotionLeavesTheModel) {
  ReferenceCase c = reference_case("default_Om0.98");
  c.speed_ratio = 1.2;  // beyond the border of validity from rest (MODEL 5)
  c.start = {};
  settings::Accuracy accuracy = good_setting();
  if (accuracy.method == Method::paper) accuracy = published(1e-4, 1.0);  // how far it goes is no matter
  const PointOutcome outcome = run(c.scene, c, accuracy, 300);
  EXPECT_EQ(outcome.status, PointStatus::left_validity);
  EXPECT_GE(outcome.failed_revolution, 0);
  EXPECT_TRUE(std::isnan(outcome.final_state[0]));
}

TEST_P(EveryMethod, RunsRepeatToTheLastBitAndOrbitsAreTheSameMotion) {
  const ReferenceCase& c = reference_case("default_Om0.40");
  const PointOutcome first = run(c.scene, c, good_setting(), 4);
  const PointOutcome second = run(c.scene, c, good_setting(), 4);
  EXPECT_EQ(first.final_state, second.final_state);
  EXPECT_EQ(first.rows, second.rows);
  settings::Scene scene = c.scene;
  scene.accuracy = good_setting();
  scene.protocol = {0, 4, 128};
  const point::Orbit orbit = solver_of(scene)->orbit(c.speed_ratio, c.start);
  ASSERT_EQ(orbit.sections.size(), 4u);
  EXPECT_EQ(orbit.sections.back(), first.final_state);
  EXPECT_EQ(orbit.time.size(), 4u * 128u);
  EXPECT_GT(*std::max_element(orbit.force.begin(), orbit.force.end()), 0.1) << "contacts are recorded";
}

TEST_P(EveryMethod, ObservablesOfContactAgreeWithThoseOfHybrid) {
  const ReferenceCase& c = reference_case("default_Om0.62");
  const auto observed = [&](const char* observable, const settings::Accuracy& accuracy) {
    settings::Scene scene = c.scene;
    scene.accuracy = accuracy;
    scene.observables = {observable};
    scene.protocol = {5, 5, 64};
    return test::run(scene, c.speed_ratio, c.start).rows.at(0).at(0);
  };
  for (const char* observable :
       {"max_displacement", "touchdowns_per_revolution", "max_contact_force", "max_root_strain"}) {
    const double expected = observed(observable, hybrid(1e-10));
    EXPECT_NEAR(observed(observable, good_setting()), expected, 3e-3 * expected) << observable;
  }
  // Where events are not located, a contact begins and ends with a step.
  const settings::Accuracy accuracy = good_setting();
  const double longest = accuracy.method == Method::fixed   ? accuracy.step
                         : accuracy.method == Method::paper ? accuracy.max_step
                                                            : 0.0;
  const double touchdowns = observed("touchdowns_per_revolution", accuracy);
  const double expected = observed("contact_fraction", hybrid(1e-10));
  EXPECT_NEAR(observed("contact_fraction", accuracy), expected,
              1e-4 * expected + touchdowns * longest / constants_of(c).period());
}

INSTANTIATE_TEST_SUITE_P(Compared, EveryMethod,
                         ::testing::Values(Method::fixed, Method::paper, Method::located),
                         [](const ::testing::TestParamInfo<Method>& instance) -> std::string {
                           switch (instance.param) {
                             case Method::fixed:
                               return "fixed";
                             case Method::paper:
                               return "paper";
                             default:
                               return "located";
                           }
                         });

}  // namespace
}  // namespace rubatlas::test

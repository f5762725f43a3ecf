// What a point may cost, and where it ends for it: flights that grow, supports too stiff for double
// precision, contacts without end, and points that are given up.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "assembly/make_line_solver.hpp"
#include "contact/pose.hpp"
#include "effect_scene.hpp"
#include "modes/flight.hpp"
#include "modes/touchdown_search.hpp"
#include "modes/work_meter.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;
using ending::StatusDetail;
using modes::Work;
using modes::WorkMeter;

/// The default rotor on a support, from rest; `added` is the section /support.
nlohmann::json on_support(const nlohmann::json& added, double speed_ratio, int revolutions) {
  return {{"support", added},
          {"grid", {{"speed_ratio", speed_ratio}}},
          {"protocol", {{"transient_revolutions", 0}, {"sampled_revolutions", revolutions}}},
          {"observables", {"poincare", "max_displacement"}}};
}

/// Of the default rotor, whose shaft has 100 N/m and 10 rad/s.
struct UnstableSupport {
  nlohmann::json added;  ///< section /support
  Eigen::Matrix2d stiffness;
  Eigen::Matrix2d damping;
  double speed_ratio;
};

std::vector<UnstableSupport> unstable_supports() {
  const Eigen::Matrix2d damping = 0.2 * Eigen::Matrix2d::Identity();
  const auto stiffness = [](double xy, double yx, double yy) {
    return (Eigen::Matrix2d() << 1.0, xy, yx, yy).finished();
  };
  const Eigen::Matrix2d feeding = (Eigen::Matrix2d() << -2.8, 0.0, 0.0, -2.3).finished();
  return {{{{"stiffness_xy", 60.0}, {"stiffness_yx", -60.0}}, stiffness(0.6, -0.6, 1.0), damping, 0.05},
          {{{"stiffness_yy", -120.0}}, stiffness(0.0, 0.0, -0.2), damping, 0.12},
          {{{"stiffness_yy", -120.0}}, stiffness(0.0, 0.0, -0.2), damping, 0.02},
          {{{"stiffness_yy", -200.0}}, stiffness(0.0, 0.0, -1.0), damping, 0.3},
          {{{"stiffness_yy", -200.0}}, stiffness(0.0, 0.0, -1.0), damping, 0.01},
          {{{"damping_xx", -30.0}, {"damping_yy", -25.0}}, stiffness(0.0, 0.0, 1.0), feeding, 0.03}};
}

TEST(FlightThatGrows, ItsTouchDownIsFoundInFewSteps) {
  int found = 0;
  for (const UnstableSupport& support : unstable_supports()) {
    SCOPED_TRACE(support.added.dump());
    const rotor::RotorConstants rotor{support.speed_ratio, 0.1, 0.0, 0.01, 0.01};
    const contact::Geometry geometry{0.19, 0.2};
    const rotor::BladeSet blades(3, rotor.speed_ratio);
    const rotor::AnyShaft shaft{
        rotor::SupportedShaft(rotor::LinearSupport(support.stiffness, support.damping, {}))};
    const rotor::Machine machine{rotor, blades, shaft, {}};
    modes::Flight flight(machine);
    const auto largest_gap = [&](double time) {
      double largest = -std::numeric_limits<double>::infinity();
      for (int k = 0; k < 3; ++k) {
        const auto direction = blades.direction(k, blades.first(time));
        largest = std::max(largest, pose_of(rotor, geometry, direction, flight.shaft(time)).gap);
      }
      return largest;
    };
    for (const double size : {1e-9, 1e-5, 1e-3}) {
      const rotor::State start{0.6 * size, 0.8 * size, 0.3 * size, -0.5 * size};
      flight.start(0.0, rotor::shaft_and_ring(start));
      WorkMeter meter;
      modes::TouchdownSearch search(flight, {3, geometry}, meter);
      const double period = rotor.period();
      const auto touchdown = search.find(period);
      const double end = touchdown ? touchdown->time : period;
      for (int i = 0; i < 1000; ++i) ASSERT_LT(largest_gap(end * i / 1000), 1e-16) << size << ", " << i;
      EXPECT_LT(search.evaluations(), 200U) << size;
      if (!touchdown) continue;
      ++found;
      EXPECT_NEAR(largest_gap(end), 0.0, 1e-15) << size;
    }
  }
  EXPECT_EQ(found, 17) << "one does not grow enough in a revolution";
}

TEST(FlightThatGrows, EndsAtTheRingAndNotForItsWork) {
  for (const UnstableSupport& support : unstable_supports()) {
    SCOPED_TRACE(support.added.dump());
    // Pressed into the ring, a rotor as slow as 0.02 hops along it 1e5 times a revolution.
    const int revolutions = support.speed_ratio == 0.02 ? 2 : 6;
    const auto outcome = run(parsed(on_support(support.added, support.speed_ratio, revolutions)));
    EXPECT_NE(outcome.status, PointStatus::integrator_failed) << ending::text_of(outcome.detail);
    EXPECT_GT(outcome.work.touchdowns, 0U);
  }
}

TEST(WorkOfAPoint, HopsWithoutNumberEndItAfterTheRevolutionsThatTheBoundAllows) {
  const auto outcome = run(parsed(on_support({{"stiffness_yy", -120.0}}, 0.02, 6)));
  EXPECT_EQ(outcome.status, PointStatus::integrator_failed);
  // A hop is a flight and a contact.
  EXPECT_TRUE(outcome.detail == StatusDetail::contact_work || outcome.detail == StatusDetail::flight_work)
      << ending::text_of(outcome.detail);
  EXPECT_GE(outcome.failed_revolution, 2);
  EXPECT_GT(outcome.work.touchdowns, 100'000U);
  EXPECT_LT(outcome.work.price, 1.01 * static_cast<double>(modes::kWorkBound.point));
}

TEST(WorkOfAPoint, ASupportThatDoublePrecisionDoesNotHoldEndsAtOnce) {
  const auto outcome = run(parsed(on_support({{"damping_xx", 1e15}}, 0.3, 2)));
  EXPECT_EQ(outcome.status, PointStatus::integrator_failed);
  EXPECT_EQ(outcome.detail, StatusDetail::beyond_precision);
  EXPECT_EQ(outcome.failed_revolution, 0);
}

TEST(WorkOfAPoint, ALightRingThatBouncesIsFollowedAtEveryTolerance) {
  // Hops die away slowly: 12 000 of them, and 40 000, are higher than the tolerance. Where they are lower the
  // tip skims, beside the other blade, too, which hops a hundred thousand times else.
  nlohmann::json scene = {{"ring_body", {{"mass", 1.718e-3}, {"compliance", 1.72e-3}, {"damping", 3.822}}},
                          {"contact", {{"friction", 0.1297}}},
                          {"grid", {{"speed_ratio", 0.3016}}},
                          {"initial", {{"x", -5.234e-3}, {"y", 3.763e-3}, {"vx", 0.04395}, {"vy", -0.02827}}},
                          {"protocol", {{"transient_revolutions", 0}, {"sampled_revolutions", 1}}}};
  for (const double tolerance : {1e-9, 1e-10}) {
    scene["accuracy"]["tolerance"] = tolerance;
    const settings::Scene parsed_scene = parsed(scene);
    const auto& at = parsed_scene.initial;
    const auto outcome = run(parsed_scene, {at.x, at.y, at.vx, at.vy});
    EXPECT_EQ(outcome.status, PointStatus::done) << tolerance << ": " << ending::text_of(outcome.detail);
    EXPECT_LT(outcome.work.touchdowns, 60'000U) << tolerance;
  }
}

TEST(WorkOfAPoint, WhatObservablesAskOfContactsIsCounted) {
  nlohmann::json scene = {{"grid", {{"speed_ratio", 0.55}}},
                          {"protocol", {{"transient_revolutions", 0}, {"sampled_revolutions", 10}}},
                          {"observables", {"poincare"}}};
  const auto motion = run(parsed(scene));
  scene["observables"] = {"poincare", "lyapunov"};
  const auto with_tangents = run(parsed(scene));
  EXPECT_EQ(motion.work.steps, with_tangents.work.steps);
  EXPECT_GT(with_tangents.work.price, 3 * motion.work.price);
}

TEST(WorkOfAPoint, ALongRevolutionIsGivenUpWhenAsked) {
  // 6e10 steps in a revolution.
  const settings::Scene scene =
      parsed({{"accuracy", {{"method", "fixed"}, {"step", 1e-6}}},
              {"grid", {{"speed_ratio", 1e-4}}},
              {"protocol", {{"transient_revolutions", 0}, {"sampled_revolutions", 1}}}});
  int asked = 0;
  const auto outcome = solver_of_first_line(scene)->run(1e-4, {}, [&] { return ++asked < 3; });
  EXPECT_EQ(outcome.status, PointStatus::pending);
  EXPECT_EQ(outcome.failed_revolution, -1);
  EXPECT_EQ(asked, 3);
  EXPECT_EQ(outcome.work.revolutions, 0U);
  EXPECT_LT(outcome.work.price, 20'000'000) << "it was asked every few milliseconds";
}

TEST(WorkMeter, SaysOnWhatTheRevolutionWasSpent) {
  const modes::WorkBound bound{1'000'000'000, 3'000'000'000, 100'000'000};
  const modes::GoOn nobody;
  for (const auto& [kind, detail] : {std::pair{Work::contact, StatusDetail::contact_work},
                                     std::pair{Work::flight, StatusDetail::flight_work},
                                     std::pair{Work::events, StatusDetail::event_work}}) {
    WorkMeter meter(bound);
    meter.begin_revolution(nobody);
    EXPECT_TRUE(meter.spend(Work::contact, 100'000'000));
    EXPECT_TRUE(meter.spend(Work::flight, 100'000'000));
    EXPECT_TRUE(meter.spend(Work::events, 100'000'000));
    while (meter.spend(kind, 50'000'000)) ASSERT_LT(meter.total(), 2'000'000'000);
    EXPECT_EQ(meter.why(), detail);
    EXPECT_FALSE(meter.spend(kind, 1)) << "a revolution that has ended does not go on";
    EXPECT_NEAR(static_cast<double>(meter.total()), 1e9, 1e8);
  }
}

TEST(WorkMeter, APointOfManyRevolutionsMayTakeSoMuchForEach) {
  const modes::WorkBound bound{1'000'000'000, 3'000'000'000, 100'000'000};
  const modes::GoOn nobody;
  WorkMeter meter(bound);
  int revolutions = 0;
  for (bool goes_on = true; goes_on && revolutions < 100; ++revolutions) {
    meter.begin_revolution(nobody);
    goes_on = meter.spend(Work::contact, 90'000'000);
  }
  EXPECT_EQ(revolutions, 100);
  while (!meter.ended()) {
    meter.begin_revolution(nobody);
    meter.spend(Work::contact, 200'000'000);
    ++revolutions;
  }
  // 9 s were spent in 100 revolutions; each further one takes 0.1 s more than it adds.
  EXPECT_NEAR(revolutions, 110, 2);
}

}  // namespace
}  // namespace rubatlas::test

/// Whole motions by the method `collocation` against `hybrid`. (`reference_orbits.cpp` holds both against
/// independent data.)
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "../support/point.hpp"

namespace rubatlas::test {
namespace {

TEST(Collocation, KeepsWhatHybridKeepsOfAPoint) {
  settings::Scene scene = default_rotor(40);
  scene.observables = observables_without_wear();
  // Exponents are means over a few revolutions, and have an error of their own, which is far greater.
  std::erase(scene.observables, "lyapunov");
  scene.protocol.transient_revolutions = 60;
  scene.accuracy.tolerance = 1e-10;
  std::vector<point::PointOutcome> by_steps;
  std::vector<point::PointOutcome> by_nodes;
  for (const double speed_ratio : {0.25, 0.36, 0.62}) {
    scene.accuracy.method = settings::Method::hybrid;
    by_steps.push_back(run(scene, speed_ratio));
    scene.accuracy.method = settings::Method::collocation;
    by_nodes.push_back(run(scene, speed_ratio));
    ASSERT_EQ(by_nodes.back().status, ending::PointStatus::done);
  }
  for (std::size_t row = 0; row < scene.observables.size(); ++row) {
    // Differences are those of the motion: at 0.25 tips hardly touch, and forces are small, their errors not.
    double largest = 0.0;
    for (const auto& steps : by_steps) {
      for (const double value : steps.rows[row]) largest = std::max(largest, std::abs(value));
    }
    for (std::size_t point = 0; point < by_steps.size(); ++point) {
      const auto& steps = by_steps[point].rows[row];
      const auto& nodes = by_nodes[point].rows[row];
      for (std::size_t i = 0; i < steps.size(); ++i) {
        if (std::isnan(steps[i]) && std::isnan(nodes[i])) continue;
        EXPECT_NEAR(nodes[i], steps[i], 1e-7 * largest)
            << scene.observables[row] << ' ' << i << " at point " << point;
      }
    }
  }
}

TEST(Collocation, FollowsAContactThatBeginsWhereItsGapIsLargest) {
  // Of four blades one points straight at the ring when the rotor starts from rest, a hundredth of a
  // millimetre beyond it.
  settings::Scene scene = default_rotor(5);
  scene.blades.count = 4;
  scene.accuracy.method = settings::Method::hybrid;
  const auto steps = run(scene, 0.3);
  scene.accuracy.method = settings::Method::collocation;
  const auto nodes = run(scene, 0.3);
  ASSERT_EQ(nodes.status, ending::PointStatus::done);
  EXPECT_EQ(nodes.work.touchdowns, steps.work.touchdowns);
  EXPECT_LE(largest_difference(nodes.final_state, steps.final_state), 1e-7 * scene.clearance());
}

TEST(Collocation, SolvesContactsOfSeveralBladesInAFractionOfTheSteps) {
  settings::Scene scene = default_rotor(20);
  scene.blades.count = 12;
  scene.blades.thickness = 2e-4;
  scene.rotor.misalignment = 0.014;
  scene.accuracy.method = settings::Method::hybrid;
  const auto steps = run(scene, 0.3);
  scene.accuracy.method = settings::Method::collocation;
  const auto nodes = run(scene, 0.3);
  ASSERT_EQ(nodes.status, ending::PointStatus::done);
  // What was rejected counts too: shorter intervals of which fewer are rejected are no loss.
  const auto attempts = [](const point::PointOutcome& outcome) {
    return outcome.work.steps + outcome.work.rejected_steps;
  };
  EXPECT_LT(2 * attempts(nodes), attempts(steps));
}

TEST(Collocation, TakesAFractionOfTheEvaluationsOfOneNodeAfterTheOther) {
  settings::Scene scene = default_rotor(100);
  scene.accuracy.method = settings::Method::collocation;
  const auto outcome = run(scene, 0.36);
  ASSERT_EQ(outcome.status, ending::PointStatus::done);
  const auto per_touchdown = [&](std::uint64_t count) {
    return static_cast<double>(count) / static_cast<double>(outcome.work.touchdowns);
  };
  // Eight nodes at once: 20 sweeps a touch-down, where steps take 130 right-hand sides one after the other.
  EXPECT_LT(per_touchdown(outcome.work.right_hand_sides) / 8.0, 24.0);
  EXPECT_LT(per_touchdown(outcome.work.steps), 5.0);
}

}  // namespace
}  // namespace rubatlas::test

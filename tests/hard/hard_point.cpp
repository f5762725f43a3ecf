#include "hard_point.hpp"
#include "assembly/make_line_solver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rubatlas::test {

settings::Scene default_rotor(int revolutions) {
  settings::Scene scene;
  scene.observables = {"poincare", "max_displacement"};
  scene.protocol = {0, revolutions, 64};
  return scene;
}

settings::Scene test_rig(int revolutions) {
  settings::Scene scene = default_rotor(revolutions);
  scene.rotor = {0.5, 2.0 * std::numbers::pi * 30.23, 0.05, 0.00036};
  scene.blades = {3, 0.04, 0.0127, 0.0005, 206e9, 0.02215};
  scene.ring.radius = 0.0625;
  return scene;
}

plan::PointParameters line_of(const settings::Scene& scene) {
  return {0.0, scene.rotor.damping_ratio, scene.contact.friction,
          scene.unbalance ? scene.unbalance->moment : 0.0, scene.blades.thickness};
}

const std::shared_ptr<assembly::BladeTables>& shared_tables() {
  static const auto kTables = assembly::make_blade_tables();
  return kTables;
}

point::PointOutcome run(const settings::Scene& scene, double speed_ratio, const point::SectionState& start,
                        const std::shared_ptr<assembly::BladeTables>& tables) {
  return assembly::make_line_solver(scene, line_of(scene), tables)->run(speed_ratio, start);
}

double largest_difference(const point::SectionState& a, const point::SectionState& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

point::SectionState section(const std::vector<double>& row, std::size_t index) {
  return {row[4 * index], row[4 * index + 1], row[4 * index + 2], row[4 * index + 3]};
}

void expect_an_honest_end(const settings::Scene& scene, const point::PointOutcome& outcome) {
  const bool done = outcome.status == point::PointStatus::done;
  const auto descriptions = observables::descriptions(scene);
  ASSERT_EQ(outcome.rows.size(), descriptions.size());
  const auto as_the_status_says = [&](double value) {
    return done ? std::isfinite(value) : std::isnan(value);
  };
  for (std::size_t i = 0; i < descriptions.size(); ++i) {
    ASSERT_EQ(outcome.rows[i].size(), descriptions[i].row_size);
    ASSERT_TRUE(std::all_of(outcome.rows[i].begin(), outcome.rows[i].end(), as_the_status_says))
        << descriptions[i].name << ", " << (done ? "done" : "not done");
  }
  ASSERT_TRUE(std::all_of(outcome.final_state.begin(), outcome.final_state.end(), as_the_status_says));
  if (done) {
    ASSERT_EQ(outcome.failed_revolution, -1);
  } else {
    ASSERT_TRUE(outcome.status == point::PointStatus::left_validity ||
                outcome.status == point::PointStatus::integrator_failed);
    ASSERT_GE(outcome.failed_revolution, 0);
    ASSERT_LT(outcome.failed_revolution,
              scene.protocol.transient_revolutions + scene.protocol.sampled_revolutions);
  }
}

}  // namespace rubatlas::test

#include "point.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "settings/observable_names.hpp"

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

std::vector<std::string> observables_without_wear() {
  const auto all = settings::observable_names();
  std::vector<std::string> names(all.begin(), all.end());
  std::erase(names, "clearance_growth");
  return names;
}

const std::shared_ptr<assembly::BladeTables>& shared_tables() {
  static const auto kTables = assembly::make_blade_tables();
  return kTables;
}

std::unique_ptr<point::LineSolver> solver_of(const settings::Scene& scene,
                                             const std::shared_ptr<assembly::BladeTables>& tables) {
  const plan::PointParameters line{0.0, scene.rotor.damping_ratio, scene.contact.friction,
                                   scene.unbalance ? scene.unbalance->moment : 0.0, scene.blades.thickness};
  return assembly::make_line_solver(scene, line, tables);
}

point::PointOutcome run(const settings::Scene& scene, double speed_ratio, const motion::SectionState& start,
                        const std::shared_ptr<assembly::BladeTables>& tables) {
  return solver_of(scene, tables)->run(speed_ratio, start);
}

std::unique_ptr<point::LineSolver> solver_of_first_line(const settings::Scene& scene) {
  return assembly::make_line_solver(scene, plan::Grid(scene).parameters(0), shared_tables());
}

point::PointOutcome run(const settings::Scene& scene, const motion::SectionState& start) {
  return run(scene, motion::PointStart(start));
}

point::PointOutcome run(const settings::Scene& scene, const motion::PointStart& start) {
  return solver_of_first_line(scene)->run(plan::Grid(scene).parameters(0).speed_ratio, start);
}

double largest_difference(const motion::SectionState& a, const motion::SectionState& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

motion::SectionState section(const std::vector<double>& row, std::size_t index) {
  return {row[4 * index], row[4 * index + 1], row[4 * index + 2], row[4 * index + 3]};
}

}  // namespace rubatlas::test

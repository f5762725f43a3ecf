#include "mpi/commands/reach.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>

#include "analysis/rules/free_shaft.hpp"
#include "plan/grid.hpp"
#include "plan/scene_of_line.hpp"
#include "settings/quantity.hpp"

namespace rubatlas::mpi {
namespace {

using analysis::FreeShaft;
using Complex = FreeShaft::Complex;

double least(const settings::Scene& scene, std::string_view pointer) {
  return std::ranges::min(settings::values_in(scene, pointer));
}
double most(const settings::Scene& scene, std::string_view pointer) {
  return std::ranges::max(settings::values_in(scene, pointer));
}

/// The smallest clearance of all points less their largest misalignment [m]; negative where blades have
/// different lengths, which this search does not treat.
double least_distance(const settings::Scene& scene) {
  if (scene.unequal_blades) return -std::numeric_limits<double>::infinity();
  settings::Scene tightest = scene;
  tightest.ring.radius = least(scene, "/ring/radius");
  tightest.blades.hub_radius = most(scene, "/blades/hub_radius");
  tightest.blades.length = most(scene, "/blades/length");
  const double misalignment =
      std::max(std::abs(least(scene, "/rotor/misalignment")), std::abs(most(scene, "/rotor/misalignment")));
  return tightest.clearance() - misalignment;
}

/// A bound of |z| over all points of a line [m]. With f the static deflection, D = z − f − Z e^{iΩτ} is a
/// free vibration, of which |D|² + |D'|² never grows. Where a point starts from the end of the one before, D
/// changes by the difference of the two Z.
double bound_of_line(const settings::Scene& line, const plan::Grid& grid, std::size_t number) {
  const auto& initial = line.initial;
  const Complex load = FreeShaft(line, grid.parameters(grid.point(number, 0)).speed_ratio).deflection();
  Complex position = Complex(initial.x, initial.y) - load;
  Complex velocity(initial.vx, initial.vy);
  double vibration = 0.0;  // square root of that sum
  double farthest = 0.0;
  for (std::size_t visit = 0; visit < grid.speed_count(); ++visit) {
    const double speed = grid.parameters(grid.point(number, visit)).speed_ratio;
    const Complex circle = FreeShaft(line, speed).circle();
    const Complex circle_velocity = Complex(0.0, speed) * circle;
    const double change = std::hypot(std::abs(position - circle), std::abs(velocity - circle_velocity));
    vibration = grid.points_depend_on_each_other() ? vibration + change : change;
    const double reach = std::abs(load) + std::abs(circle) + vibration;
    if (!std::isfinite(reach)) return std::numeric_limits<double>::infinity();
    farthest = std::max(farthest, reach);
    if (!grid.points_depend_on_each_other()) continue;
    position = circle;
    velocity = circle_velocity;
  }
  return farthest;
}

}  // namespace

std::optional<FreeReach> reach_without_contact(const settings::Scene& scene) {
  // Limits the time that a user waits without knowing why; each line takes a copy of the scene.
  constexpr std::size_t kMostPoints = 100'000;
  constexpr std::size_t kMostLines = 1'000;
  FreeReach reach{.displacement = 0.0, .distance = least_distance(scene)};
  if (reach.distance < 0.0) return std::nullopt;
  const plan::Grid grid(scene);
  if (grid.point_count() > kMostPoints || grid.line_count() > kMostLines) return std::nullopt;
  for (std::size_t number = 0; number < grid.line_count(); ++number) {
    const auto line = plan::scene_of_line(scene, grid.parameters(grid.point(number, 0)));
    const double bound = bound_of_line(line, grid, number);
    // A shaft at rest that nothing drives stays at rest under any support.
    if (bound > 0.0 && !FreeShaft::describes(line)) return std::nullopt;
    reach.displacement = std::max(reach.displacement, bound);
    if (!(reach.displacement <= reach.distance)) return std::nullopt;
  }
  return reach;
}

std::optional<double> overlap_at_equilibrium(const settings::Scene& scene, double misalignment) {
  if (scene.gravity || scene.side_load || scene.unequal_blades) return std::nullopt;
  return std::abs(misalignment) - scene.clearance();
}

double farthest_start(const settings::Scene& scene, double height) {
  double farthest = 0.0;
  for (const double x : settings::values_in(scene, "/initial/x")) {
    for (const double y : settings::values_in(scene, "/initial/y")) {
      farthest = std::max(farthest, std::hypot(x, y - height));
    }
  }
  return farthest;
}

bool has_touched(const settings::Scene& scene, const motion::WorkCounts& work) {
  if (work.touchdowns + work.liftoffs > 0) return true;
  return work.right_hand_sides > 0 && farthest_start(scene, 0.0) > least_distance(scene);
}

}  // namespace rubatlas::mpi

#include "mpi/notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpi/explain_text.hpp"

namespace rubatlas::mpi {
namespace {

/// Largest amplitude of the rotor without contact under the scene's unbalance [m] (MODEL 4.5), over the grid.
double largest_free_amplitude(const scene::Scene& scene) {
  double largest = 0.0;
  const double eccentricity = scene.grid.unbalance.back() / scene.rotor.mass;
  const double damping = scene.grid.damping_ratio.front();
  for (const double speed : scene.grid.speed_ratio) {
    const double detuning = std::hypot(1.0 - speed * speed, 2.0 * damping * speed);
    if (eccentricity > 0.0) largest = std::max(largest, eccentricity * speed * speed / detuning);
  }
  return largest;
}

}  // namespace

std::vector<std::string> notes_on(const scene::Scene& scene, const CostEstimate& cost) {
  std::vector<std::string> result;
  const auto& initial = scene.initial;
  const bool at_rest = initial.x == 0.0 && initial.y == 0.0 && initial.vx == 0.0 && initial.vy == 0.0;
  if (cost.left_validity > 0) {
    result.push_back(
        fmt::format("{} of the {} points tried left the model: their rows will be NaN, with status 2",
                    cost.left_validity, cost.trials));
  }
  if (cost.integrator_failed > 0) {
    result.push_back(fmt::format(
        "{} of the {} points tried could not be integrated: their rows will be NaN, with status 3",
        cost.integrator_failed, cost.trials));
  }
  // MODEL 5: from rest the default rotor stays inside up to 1.02, leaves at 1.03 and always between 1.05
  // and 1.24.
  if (scene.grid.speed_ratio.back() > 1.0) {
    result.emplace_back(
        "speeds beyond Ω = 1 reach the border of the model: the default rotor leaves it at 1.03 and "
        "always from 1.05 to 1.24. Near the border the very revolution of escape depends on the last "
        "digits");
  }
  // With quantities that are swept by pointers this may be so on some lines and not on others.
  if (at_rest && scene.grid.swept.empty() && std::abs(scene.rotor.misalignment) <= scene.clearance() &&
      largest_free_amplitude(scene) == 0.0) {
    result.emplace_back("the blades never reach the ring: nothing moves, every row is zero");
  }
  if (const double amplitude = largest_free_amplitude(scene); std::isinf(amplitude)) {
    result.emplace_back("Ω = 1 without damping: under its unbalance the free shaft moves out without bound");
  } else if (amplitude > 0.0) {
    result.push_back(
        fmt::format("without contact the unbalance alone would move the shaft by up to {}, {} clearances",
                    length(amplitude),
                    scene.clearance() > 0.0 ? fmt::format("{:.3g}", amplitude / scene.clearance()) : "many"));
  }
  if (scene.grid.damping_ratio.front() == 0.0) {
    result.emplace_back("ζ = 0: free motion never decays, a transient of any length leaves it as it is");
  }
  if (scene.protocol.transient_revolutions == 0) {
    result.emplace_back("no transient: the sections begin with the very first revolution");
  }
  const bool has_passing = std::find(scene.observables.begin(), scene.observables.end(),
                                     "poincare_blade_passing") != scene.observables.end();
  if (!has_passing && scene.unbalance == std::nullopt && scene.blades.count > 1) {
    result.push_back(
        fmt::format("without unbalance the natural period is a blade passing, T/{}: the observable "
                    "`poincare_blade_passing` would show period doublings that once-per-revolution "
                    "sections hide",
                    scene.blades.count));
  }
  return result;
}

}  // namespace rubatlas::mpi

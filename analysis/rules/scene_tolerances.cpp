#include "analysis/rules/scene_tolerances.hpp"

namespace rubatlas::analysis {
namespace {

/// Displacements below this share of the clearance count as equally small.
constexpr double kNegligible = 1e-6;
/// The closing distance of a periodic orbit may be this many tolerances of the integrator.
constexpr double kIntegratorTolerances = 100.0;

}  // namespace

double length_scale(const settings::Scene& scene) {
  return scene.clearance() > 0.0 ? scene.clearance() : 0.1 * scene.blades.length;
}

ClosingTolerance closing_tolerance(const settings::Scene& scene) {
  return {.floor = kIntegratorTolerances * scene.accuracy.tolerance * length_scale(scene)};
}

double negligible_displacement(const settings::Scene& scene) {
  return kNegligible * length_scale(scene);
}

}  // namespace rubatlas::analysis

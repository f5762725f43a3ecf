#include "problem.hpp"

#include <cmath>

namespace rubatlas::bench {

settings::Scene default_scene(int revolutions, double tolerance) {
  settings::Scene scene;
  const int transient = 2 * revolutions / 3;
  scene.protocol.transient_revolutions = transient;
  scene.protocol.sampled_revolutions = revolutions - transient;
  scene.protocol.settle = settings::Settle::never;
  scene.accuracy.tolerance = tolerance;
  scene.observables = {"poincare"};
  return scene;
}

plan::PointParameters line_of(const settings::Scene& scene, double speed_ratio) {
  return {speed_ratio, scene.rotor.damping_ratio, scene.contact.friction, 0.0, scene.blades.thickness};
}

rotor::RotorConstants rotor_of(const settings::Scene& scene, double speed_ratio) {
  const settings::Rotor& rotor = scene.rotor;
  return {speed_ratio, rotor.damping_ratio, rotor.misalignment,
          1.0 / (rotor.mass * rotor.natural_frequency * rotor.natural_frequency), scene.clearance()};
}

contact::ElasticaContact contact_of(const settings::Scene& scene,
                                    const std::shared_ptr<const blade::ElasticaCurve>& curve) {
  const settings::Blades& blades = scene.blades;
  const double stiffness = blades.youngs_modulus * blades.width * std::pow(blades.thickness, 3) / 12.0;
  return {{blades.hub_radius + blades.length, scene.ring.radius},
          {blades.length, blades.thickness, stiffness},
          curve};
}

std::vector<motion::SectionState> sections_of(const std::vector<double>& row) {
  std::vector<motion::SectionState> sections;
  for (std::size_t i = 0; i + 3 < row.size(); i += 4)
    sections.push_back({row[i], row[i + 1], row[i + 2], row[i + 3]});
  return sections;
}

}  // namespace rubatlas::bench

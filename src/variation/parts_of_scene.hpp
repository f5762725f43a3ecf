/// The parts of a scene: its blades, their friction, and the machine that they turn in.
#pragma once

#include <cstddef>
#include <vector>

#include "blade/elastica_curve.hpp"
#include "contact/elastica_contact.hpp"
#include "contact/friction_law.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/constants.hpp"
#include "rotor/machine.hpp"
#include "settings/effects/list.hpp"
#include "settings/scene.hpp"

namespace rubatlas::variation {

/// The scene's blade, with the errors of each.
inline std::vector<settings::Blades> each_blade(const settings::Scene& line) {
  const auto count = static_cast<std::size_t>(line.blades.count);
  std::vector<settings::Blades> blades(count, line.blades);
  if (!line.unequal_blades) return blades;
  const auto errors = line.unequal_blades->errors(line.blades.count);
  for (std::size_t k = 0; k < count; ++k) {
    blades[k].length += errors[k].length;
    blades[k].thickness += errors[k].thickness;
  }
  return blades;
}
/// Places of the blades on the hub, from that of blade 0 [rad].
inline std::vector<double> angles_of(const settings::Scene& line) {
  std::vector<double> angles = rotor::equal_angles(line.blades.count);
  if (!line.unequal_blades) return angles;
  const auto errors = line.unequal_blades->errors(line.blades.count);
  for (std::size_t k = 0; k < angles.size(); ++k) angles[k] += errors[k].angle;
  return angles;
}
inline contact::Geometry geometry_of(const settings::Ring& ring, const settings::Blades& blade) {
  return {blade.hub_radius + blade.length, ring.radius};
}
inline contact::ElasticaContact::Blade blade_of(const settings::Blades& blade) {
  const double thickness = blade.thickness;
  return {blade.length, thickness,
          blade.youngs_modulus * blade.width * thickness * thickness * thickness / 12.0};
}

inline blade::Theory theory_of(const settings::Scene& line) {
  return line.contact.law == settings::ContactLaw::beam_column ? blade::Theory::beam_column
                                                               : blade::Theory::elastica;
}

/// The friction law, of tips that do not stick.
inline contact::Friction friction_of(const settings::Scene& line) {
  using effects::Effects;
  const double per_time = 1.0 / line.rotor.natural_frequency;
  const double friction = line.contact.friction;
  if (effects::acts<&Effects::stribeck>(line)) {
    const effects::Stribeck& law = *line.stribeck;
    return contact::Friction::stribeck(law.static_friction, friction, law.velocity * per_time,
                                       law.regularising_velocity * per_time);
  }
  // Without friction there is nothing to be regularised.
  if (effects::acts<&Effects::regularised_friction>(line) && friction != 0.0)
    return contact::Friction::regularised(friction, line.regularised_friction->velocity * per_time);
  return contact::Friction::coulomb(friction);
}

/// The constants of a line's point.
inline rotor::RotorConstants constants_of(const settings::Scene& line, double speed_ratio) {
  const double clearance = line.clearance();
  const double frequency = line.rotor.natural_frequency;
  return {speed_ratio, line.rotor.damping_ratio, line.rotor.misalignment,
          1.0 / (line.rotor.mass * frequency * frequency),
          clearance > 0.0 ? clearance : 0.1 * line.blades.length};
}

/// What turns and pushes the shaft, and the ring: only what the scene has acts.
rotor::Machine machine_of(const settings::Scene& line, double speed_ratio);

}  // namespace rubatlas::variation

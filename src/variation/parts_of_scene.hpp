/// The parts of a scene: its blades, their friction, and the support of its shaft.
#pragma once

#include <cstddef>
#include <vector>

#include "blade/elastica_curve.hpp"
#include "contact/elastica_contact.hpp"
#include "contact/friction_law.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/support_matrices.hpp"
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

/// K and C of z'' + C z' + K z = f at a speed ratio Ω (`settings/effects/support.hpp`).
inline rotor::SupportMatrices support_of(const settings::Scene& line, double speed_ratio) {
  const effects::Support added = line.support.value_or(effects::Support{});
  const double damping = line.rotor.mass * line.rotor.natural_frequency;
  const double stiffness = damping * line.rotor.natural_frequency;
  rotor::SupportMatrices matrices = rotor::isotropic_shaft(line.rotor.damping_ratio);
  Eigen::Matrix2d more;
  more << added.stiffness_xx, added.stiffness_xy, added.stiffness_yx, added.stiffness_yy;
  matrices.stiffness += more / stiffness;
  more << added.damping_xx, added.damping_xy, added.damping_yx, added.damping_yy;
  matrices.damping += more / damping;
  return rotor::with_rotating_damping(matrices, 0.5 * added.rotating_damping / damping, speed_ratio);
}

}  // namespace rubatlas::variation

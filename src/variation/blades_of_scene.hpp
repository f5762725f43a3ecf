/// The blades of a scene, and their contact laws.
#pragma once

#include <cstddef>
#include <vector>

#include "contact/elastica_contact.hpp"
#include "rotor/blade_set.hpp"
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

}  // namespace rubatlas::variation

/// Contact laws of the blades of a scene.
#pragma once

#include <memory>
#include <utility>

#include "contact/elastica_contact.hpp"
#include "settings/scene.hpp"

namespace rubatlas::variation {

inline contact::Geometry geometry_of(const settings::Ring& ring, const settings::Blades& blade) {
  return {blade.hub_radius + blade.length, ring.radius};
}
inline contact::ElasticaContact::Blade blade_of(const settings::Blades& blade) {
  const double thickness = blade.thickness;
  return {blade.length, thickness,
          blade.youngs_modulus * blade.width * thickness * thickness * thickness / 12.0};
}

}  // namespace rubatlas::variation

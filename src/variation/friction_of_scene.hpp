/// The friction law of a scene.
#pragma once

#include "contact/friction_law.hpp"
#include "settings/effects/list.hpp"
#include "settings/scene.hpp"

namespace rubatlas::variation {

/// Of tips that do not stick.
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

}  // namespace rubatlas::variation

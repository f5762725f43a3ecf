/// The friction law of a scene, as a type.
#pragma once

#include "contact/friction_law.hpp"
#include "settings/effects/list.hpp"
#include "settings/scene.hpp"

namespace rubatlas::variation {

/// Calls `use` with the friction law of a line; velocities become metres per unit τ.
template <class Use>
auto with_friction(const settings::Scene& line, Use use) {
  using effects::Effects;
  const double per_time = 1.0 / line.rotor.natural_frequency;
  const double friction = line.contact.friction;
  if (effects::acts<&Effects::stribeck>(line)) {
    const effects::Stribeck& law = *line.stribeck;
    return use(contact::VelocityFriction(contact::StribeckFriction{
        law.static_friction, friction, law.velocity * per_time, law.regularising_velocity * per_time}));
  }
  // Without friction there is nothing to be regularised.
  if (effects::acts<&Effects::regularised_friction>(line) && friction != 0.0)
    return use(contact::VelocityFriction(
        contact::RegularisedFriction{friction, line.regularised_friction->velocity * per_time}));
  return use(contact::CoulombFriction{friction});
}

}  // namespace rubatlas::variation

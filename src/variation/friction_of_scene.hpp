/// The friction law of a scene, as a type.
#pragma once

#include "contact/friction_law.hpp"
#include "settings/combinations.hpp"
#include "settings/scene.hpp"

namespace rubatlas::variation {

/// Calls `use` with the friction law of a line on which these effects act; velocities become metres per unit
/// τ.
template <class Use>
auto with_friction(const settings::Scene& line, settings::EffectSet acting, Use use) {
  using effects::Effects;
  const double per_time = 1.0 / line.rotor.natural_frequency;
  const double friction = line.contact.friction;
  if (acting.contains<&Effects::stribeck>()) {
    const effects::Stribeck& law = *line.stribeck;
    return use(contact::StribeckFriction{law.static_friction, friction, law.velocity * per_time,
                                         law.regularising_velocity * per_time});
  }
  if (acting.contains<&Effects::regularised_friction>()) {
    return use(contact::RegularisedFriction{friction, line.regularised_friction->velocity * per_time});
  }
  return use(contact::CoulombFriction{friction});
}

}  // namespace rubatlas::variation

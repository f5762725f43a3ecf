/// From the effects that a motion consumes to the type of its friction law.
#pragma once

#include "assembly/effect_families.hpp"
#include "contact/friction_law.hpp"

namespace rubatlas::assembly {

/// Calls `use` with the friction law of a line; velocities become metres per unit τ.
template <class Use>
auto with_friction(const FamilyRequest& request, Use use) {
  using effects::Effects;
  const settings::Scene& line = request.line;
  const settings::EffectSet consumed = request.combination.consumed;
  const double per_time = 1.0 / line.rotor.natural_frequency;
  const double friction = line.contact.friction;
  if (consumed.contains<&Effects::stribeck>()) {
    const effects::Stribeck& law = *line.stribeck;
    return use(contact::StribeckFriction{law.static_friction, friction, law.velocity * per_time,
                                         law.regularising_velocity * per_time});
  }
  if (consumed.contains<&Effects::regularised_friction>()) {
    return use(contact::RegularisedFriction{friction, line.regularised_friction->velocity * per_time});
  }
  return use(contact::CoulombFriction{friction});
}

}  // namespace rubatlas::assembly

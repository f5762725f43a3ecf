#include "collocation/friction_numbers.hpp"

#include <variant>

namespace rubatlas::collocation {

FrictionNumbers numbers_of(const contact::CoulombFriction& friction) {
  return {.law = FrictionNumbers::Law::coulomb, .friction = friction.friction};
}

FrictionNumbers numbers_of(const contact::StickingFriction& friction) {
  return {.law = FrictionNumbers::Law::coulomb,
          .friction = friction.friction,
          .static_friction = friction.largest_holding};
}

FrictionNumbers numbers_of(const contact::VelocityFriction& friction) {
  if (const auto* regularised = std::get_if<contact::RegularisedFriction>(&friction.law()))
    return {.law = FrictionNumbers::Law::regularised,
            .friction = regularised->friction,
            .regularising_velocity = regularised->regularising_velocity};
  const auto& stribeck = std::get<contact::StribeckFriction>(friction.law());
  return {.law = FrictionNumbers::Law::stribeck,
          .friction = stribeck.kinetic_friction,
          .static_friction = stribeck.static_friction,
          .stribeck_velocity = stribeck.stribeck_velocity,
          .regularising_velocity = stribeck.regularising_velocity};
}

}  // namespace rubatlas::collocation

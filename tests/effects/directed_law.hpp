/// Elastic blades under a friction law of their own, for motions below the scene.
#pragma once

#include <type_traits>
#include "../hard/recorded_motion.hpp"

#include "contact/directed_elastica.hpp"

namespace rubatlas::test {

template <class Friction>
auto directed_law(const HardRotor& rotor, const Friction& friction,
                  contact::LoadDirection direction = contact::LoadDirection::axial) {
  using Compiled = std::conditional_t<Friction::kDependsOnVelocity, contact::VelocityFriction, Friction>;
  return contact::DirectedElastica<Compiled>(direction, rotor.geometry(),
                                             {rotor.length, rotor.thickness, rotor.bending_stiffness},
                                             Compiled(friction));
}

}  // namespace rubatlas::test

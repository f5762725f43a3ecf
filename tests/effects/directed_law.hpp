/// Elastic blades under a friction law of their own, for motions below the scene.
#pragma once

#include "../hard/recorded_motion.hpp"

#include "contact/directed_elastica.hpp"

namespace rubatlas::test {

inline contact::DirectedElastica directed_law(
    const HardRotor& rotor, const contact::Friction& friction,
    contact::LoadDirection direction = contact::LoadDirection::axial) {
  return {direction, rotor.geometry(), {rotor.length, rotor.thickness, rotor.bending_stiffness}, friction};
}

}  // namespace rubatlas::test

/// Elastic blades under a friction law of their own, for motions below the scene.
#pragma once

#include "../hard/recorded_motion.hpp"
#include "contact/directed_elastica.hpp"

namespace rubatlas::test {

template <class Friction, class Direction = contact::AxialLoad>
contact::DirectedElastica<Direction, Friction> directed_law(const HardRotor& rotor,
                                                            const Friction& friction) {
  return {rotor.geometry(), {rotor.length, rotor.thickness, rotor.bending_stiffness}, friction};
}

}  // namespace rubatlas::test

/// The paper's machine, as far as a test says nothing else.
#pragma once

#include <vector>

#include "rotor/machine.hpp"

namespace rubatlas::test {

/// Nothing but shaft and ring acts.
inline const rotor::Harmonics kNoForcing(std::vector<rotor::Harmonic>{});

/// The isotropic shaft; the ring stands still where nothing else is said.
inline rotor::Machine machine_of(const rotor::RotorConstants& rotor, const rotor::BladeSet& blades,
                                 const rotor::Harmonics& forcing = kNoForcing, const rotor::Ring& ring = {}) {
  return {rotor, blades, {forcing}, ring};
}
inline rotor::Machine machine_of(const rotor::RotorConstants& rotor, const rotor::BladeSet& blades,
                                 const rotor::Harmonic& forcing, const rotor::Ring& ring = {}) {
  return machine_of(rotor, blades, rotor::Harmonics({forcing}), ring);
}

}  // namespace rubatlas::test

/// Random legal scenes for the search: whatever the reader accepts, the solver must end with a status.
///
/// Three kinds in turn. `anywhere`: every quantity of the reader's own list is drawn over its whole legal
/// range, log-uniformly where that spans decades. `fitting`: the same, but blades, misalignment and start are
/// drawn in proportion to the ring, so that most rotors reach it. `rubbing`: also stiffness and mass in
/// proportion, speed and damping among the awkward ones (ζ = 0, 1, 1 ± 1e-12; Ω = 1; misalignment just above
/// or below the clearance), so that most points have long lives full of contacts.
#pragma once

#include <cstdint>
#include <string>

#include "settings/scene.hpp"

namespace rubatlas::test {

/// The index is the seed; the same text on every machine.
std::string random_scene_text(std::uint64_t index);

/// Read by the reader itself, which must accept it.
settings::Scene random_scene(std::uint64_t index);

}  // namespace rubatlas::test

/// The machine of a line: what turns and pushes the shaft, and the ring.
#pragma once

#include "rotor/machine.hpp"
#include "settings/combinations.hpp"
#include "settings/scene.hpp"

namespace rubatlas::assembly {

/// Only what the scene has acts. `kind`: the closed form of the isotropic shaft at constant speed is kept
/// where the line has both.
rotor::Machine machine_of(const settings::Scene& line, settings::Machine kind, double speed_ratio);

}  // namespace rubatlas::assembly

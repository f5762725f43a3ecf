/// What the modes of one motion share.
#pragma once

#include "modes/contact_limits.hpp"
#include "modes/work_meter.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::modes {

class Law;

/// All of it outlives the modes.
struct ContactSetup {
  const rotor::Machine* machine;
  const Law* law;
  ContactLimits limits;
  WorkMeter* meter;
};

}  // namespace rubatlas::modes

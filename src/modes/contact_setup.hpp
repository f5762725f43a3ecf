/// What the modes of one motion share.
#pragma once

#include "modes/work_meter.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::modes {

class Law;

/// What bounds a mode in contact and how accurate it is.
struct ContactLimits {
  double tolerance;       ///< local error of a step [m]: accuracy.tolerance × δc
  double max_shortening;  ///< of δ/L [-]
};

/// All of it outlives the modes.
struct ContactSetup {
  const rotor::Machine* machine;
  const Law* law;
  ContactLimits limits;
  WorkMeter* meter;
};

}  // namespace rubatlas::modes

/// What bounds a mode in contact and how accurate it is.
#pragma once

namespace rubatlas::modes {

struct ContactLimits {
  double tolerance;       ///< local error of a step [m]: accuracy.tolerance × δc
  double max_shortening;  ///< of δ/L [-]
};

}  // namespace rubatlas::modes

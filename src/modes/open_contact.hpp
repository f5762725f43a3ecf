/// A blade in contact.
#pragma once

#include <limits>

#include "blade/inclined_elastica.hpp"

namespace rubatlas::modes {

/// A contact that is open: which blade, its slip direction, and what its blade's equilibrium is found from.
struct OpenContact {
  int blade;
  double slip;            ///< s = ±1, 0 where the tip sticks
  double bending;         ///< u of a blade under an axial load [-]; 0: unloaded, or not known
  blade::Bend bend{};     ///< κ and φ of a blade under an inclined load; 0: not known
  double yielding = 0.0;  ///< y of a ring with dampers under the tip [m]; 0: a new contact
  bool straight = false;  ///< the blade does not bend, and only the ring yields under it
  bool skims = false;     ///< the tip stays on the ring under a share of its force (MODEL 4.9)
  /// τ of the last slip reversal, and of the one before.
  double reversed = -std::numeric_limits<double>::infinity();
  double reversed_before = -std::numeric_limits<double>::infinity();
};

}  // namespace rubatlas::modes

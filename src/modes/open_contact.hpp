/// A blade in contact.
#pragma once

#include <limits>

#include "collocation/blades_in_contact.hpp"

namespace rubatlas::modes {

/// A contact that is open: which blade, its slip direction, and what its blade's equilibrium is found from,
/// all 0 where that is not known.
struct OpenContact : collocation::Touch {
  /// τ of the last slip reversal, and of the one before.
  double reversed = -std::numeric_limits<double>::infinity();
  double reversed_before = -std::numeric_limits<double>::infinity();
};

}  // namespace rubatlas::modes

/// Modes of elastic blades under an axial load, which have one unknown, the bending parameter u.
#pragma once

#include "modes/carried.hpp"
#include "modes/skimming.hpp"
#include "modes/solved.hpp"
#include "motion/resting_modes.hpp"

namespace rubatlas::motion {

template <class Law, class Forcing, class Pair, class Blades>
requires Law::kHasBending struct ModesOf<Law, Forcing, Pair, Blades>
    : ModesWithRest<Law, Forcing, Pair, Blades> {
  static constexpr bool kCollocates = CollocationOf<Pair>::kOccurs;
  using Collocated = typename CollocationOf<Pair>::Mode;
  static constexpr bool kCarries = true;
  using Carried = modes::Carried<Law, Forcing, Blades>;
  using Skimming = modes::Skimming<Law, Forcing, Blades>;
  using Solved = modes::Solved<Law, Forcing, Blades>;
};

}  // namespace rubatlas::motion

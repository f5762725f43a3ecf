/// Modes of elastic blades under an inclined load, which have two unknowns, κ and φ, and carry both.
#pragma once

#include "contact/friction_law.hpp"
#include "modes/carried_bends.hpp"
#include "modes/sticking_elastic.hpp"
#include "motion/resting_modes.hpp"

namespace rubatlas::motion {

template <class Law, class Forcing, class Pair, class Blades>
requires HasTwoUnknowns<typename Law::OfBlade>
struct ModesOf<Law, Forcing, Pair, Blades> : ModesWithRest<Law, Forcing, Pair, Blades> {
  static constexpr bool kSticks = contact::Sticks<Law>;
  using Sticking = modes::StickingElastic<Law, Forcing, Blades>;
  using Solved = modes::CarriedBends<Law, Forcing, Blades>;
};

}  // namespace rubatlas::motion

/// Modes of rigid blades on a ring that yields under each tip; their force follows from the gap.
#pragma once

#include "contact/friction_law.hpp"
#include "modes/solved.hpp"
#include "modes/sticking.hpp"
#include "motion/modes_of.hpp"
#include "rotor/bodies.hpp"

namespace rubatlas::motion {

template <class Law, class Forcing, class Pair, class Blades>
requires(Law::kLoadFollowsGap && !rotor::kRingFollows<Forcing>) struct ModesOf<Law, Forcing, Pair, Blades>
    : ModesOfAnyLaw<Law, Pair> {
  static constexpr bool kSticks = contact::Sticks<Law>;
  using Sticking = modes::Sticking<Law, Forcing, Blades>;
  using Solved = modes::Solved<Law, Forcing, Blades>;
};

}  // namespace rubatlas::motion

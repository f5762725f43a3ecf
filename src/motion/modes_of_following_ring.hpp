/// Modes of rigid blades on a ring without mass, which stands where the blades push it.
#pragma once

#include "modes/following_ring.hpp"
#include "motion/modes_of.hpp"
#include "rotor/bodies.hpp"

namespace rubatlas::motion {

template <class Law, class Forcing, class Pair, class Blades>
requires(Law::kLoadFollowsGap&& rotor::kRingFollows<Forcing>) struct ModesOf<Law, Forcing, Pair, Blades>
    : ModesOfAnyLaw<Law, Pair> {
  static constexpr bool kRingFollows = true;
  using FollowingRing = modes::FollowingRing<Law, Forcing, Blades>;
  using Solved = FollowingRing;
};

}  // namespace rubatlas::motion

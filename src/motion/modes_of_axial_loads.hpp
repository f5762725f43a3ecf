/// Modes of elastic blades under an axial load, which have one unknown, the bending parameter u.
#pragma once

#include "modes/carried.hpp"
#include "modes/collocated.hpp"
#include "modes/skimming.hpp"
#include "modes/solved.hpp"
#include "motion/resting_modes.hpp"

namespace rubatlas::motion {

/// Machines of which collocation knows the equations.
template <class Forcing>
inline constexpr bool kCollocatesOn = false;
template <>
inline constexpr bool kCollocatesOn<rotor::AnyShaft> = true;
template <>
inline constexpr bool kCollocatesOn<rotor::WithRingBody<rotor::AnyShaft>> = true;

template <class Law, class Forcing, class Pair, class Blades>
requires Law::kHasBending struct ModesOf<Law, Forcing, Pair, Blades>
    : ModesWithRest<Law, Forcing, Pair, Blades> {
  static constexpr bool kCollocates = kCollocatesOn<Forcing> &&
                                      std::is_same_v<Law, modes::Collocated::Laws> &&
                                      std::is_same_v<Blades, rotor::RipplingBlades>;
  using Collocated = modes::Collocated;
  static constexpr bool kCarries = true;
  using Carried = modes::Carried<Law, Forcing, Blades>;
  using Skimming = modes::Skimming<Law, Forcing, Blades>;
  using Solved = modes::Solved<Law, Forcing, Blades>;
};

}  // namespace rubatlas::motion

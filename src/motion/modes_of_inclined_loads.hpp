/// Modes of elastic blades under an inclined load, which have two unknowns, κ and φ, and carry both.
#pragma once

#include <memory>
#include <type_traits>

#include "collocation/inclined_law.hpp"
#include "contact/friction_law.hpp"
#include "modes/carried_bends.hpp"
#include "modes/collocated.hpp"
#include "modes/sticking_elastic.hpp"
#include "motion/resting_modes.hpp"

namespace rubatlas::motion {

template <class Law, class Forcing, class Pair, class Blades>
requires HasTwoUnknowns<typename Law::OfBlade>
struct ModesOf<Law, Forcing, Pair, Blades> : ModesWithRest<Law, Forcing, Pair, Blades> {
  static constexpr bool kSticks = contact::Sticks<Law>;
  /// Tips that may stick go on in steps.
  static constexpr bool kCollocates =
      kCollocatesOn<Forcing> && std::is_same_v<Blades, rotor::RipplingBlades> && !contact::Sticks<Law>;
  using Collocated = modes::Collocated;
  static std::unique_ptr<collocation::ArcLaw> arc_law(const Law& law, int /*blade_count*/,
                                                      double max_shortening) {
    return std::make_unique<collocation::InclinedLaw<Law>>(law, max_shortening);
  }
  using Sticking = modes::StickingElastic<Law, Forcing, Blades>;
  using Solved = modes::CarriedBends<Law, Forcing, Blades>;
};

}  // namespace rubatlas::motion

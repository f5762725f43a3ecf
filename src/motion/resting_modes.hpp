/// The mode of tips that come to rest where their slip reversals accumulate, for the kinds of laws that have
/// one.
#pragma once

#include <type_traits>

#include "contact/resting_law.hpp"
#include "modes/sticking_elastic.hpp"
#include "motion/modes_of.hpp"

namespace rubatlas::motion {

template <class Law, class Forcing, class Pair, class Blades>
struct ModesWithRest : ModesOfAnyLaw<Law, Pair> {
  using RestingLaw = typename contact::RestingLawOf<Law>::Type;
  static constexpr bool kRests = !std::is_void_v<RestingLaw>;
  using Resting = modes::Resting<RestingLaw, Forcing, Blades>;
};

}  // namespace rubatlas::motion

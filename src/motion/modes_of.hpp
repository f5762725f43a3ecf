/// Which modes a motion has, by its contact law and by the bodies that move: a mode that cannot occur is not
/// compiled.
#pragma once

#include <type_traits>

#include "contact/damped_ring.hpp"
#include "contact/friction_law.hpp"
#include "contact/resting_law.hpp"
#include "modes/carried.hpp"
#include "modes/carried_bends.hpp"
#include "modes/contact_phase.hpp"
#include "modes/damped_ring.hpp"
#include "modes/following_ring.hpp"
#include "modes/skimming.hpp"
#include "modes/solved.hpp"
#include "modes/sticking_elastic.hpp"
#include "motion/contact_reset.hpp"

namespace rubatlas::motion {

template <class Law, class Forcing, class Pair, class Blades>
struct ModesOf {
  using Reset = ContactReset<typename Law::OfBlade>;

  // Only blades with a bending parameter are carried, and skim: their contacts may start from a finite force.
  static constexpr bool kCarries = Reset::kCarries;
  using Carried = modes::Carried<Law, Forcing, Blades>;
  using Skimming = modes::Skimming<Law, Forcing, Blades>;

  // Only tips that can stick have a mode of sticking; this mode also decides whether they stick.
  static constexpr bool kSticks = contact::Sticks<Law>;
  using Sticking = modes::StickingOf<Law, Forcing, Blades>;

  // Tips that always slip come to rest where their slip reversals accumulate, under a separate law.
  using RestingLaw = typename contact::RestingLawOf<Law>::Type;
  static constexpr bool kRests = !std::is_void_v<RestingLaw>;
  using Resting = modes::StickingElastic<RestingLaw, Forcing, Blades>;

  // All other contacts: the two unknowns of a blade are carried as states; a ring without mass is put where
  // its spring balances the blades; a ring with dampers has a mode for its yielding.
  static constexpr bool kRingFollows = rotor::kRingFollows<Forcing>;
  using FollowingRing = modes::FollowingRing<Law, Forcing, Blades>;
  static constexpr auto solved() {
    if constexpr (HasTwoUnknowns<typename Law::OfBlade>) {
      return std::type_identity<modes::CarriedBends<Law, Forcing, Blades>>{};
    } else if constexpr (kRingFollows) {
      return std::type_identity<FollowingRing>{};
    } else if constexpr (contact::kOnDampedRing<Law>) {
      return std::type_identity<modes::DampedRingOf<Law, Forcing, Blades>>{};
    } else {
      return std::type_identity<modes::Solved<Law, Forcing, Blades>>{};
    }
  }
  using Solved = typename decltype(solved())::type;

  template <class Mode>
  using Phase = modes::ContactPhase<Mode, Pair>;
};

}  // namespace rubatlas::motion

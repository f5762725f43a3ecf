/// Which phases a motion has, by its law of contact and by what moves: none is compiled that cannot occur.
#pragma once

#include <type_traits>
#include <variant>

#include "contact/friction_law.hpp"
#include "contact/resting_law.hpp"
#include "modes/carried_bends.hpp"
#include "modes/contact_phase.hpp"
#include "modes/following_ring.hpp"
#include "modes/skimming_contact.hpp"
#include "modes/sticking_elastic_contacts.hpp"

namespace rubatlas::motion {

/// Tips that always slip, but come to rest where their slip reversals accumulate: that of no law, and of one.
template <class RestingLaw, class Forcing, class Pair, class Blades>
struct RestingPhases {
  using System = modes::StickingElasticContacts<RestingLaw, Forcing, Blades>;
  using Phase = modes::ContactPhase<System, RestingLaw, Pair, Blades>;
};
template <class Forcing, class Pair, class Blades>
struct RestingPhases<void, Forcing, Pair, Blades> {
  using System = std::monostate;
  using Phase = std::monostate;
};

/// Blades of which κ and φ are unknown, not the bending parameter alone.
template <class Blade>
concept HasTwoUnknowns = requires {
  &Blade::Drift::misdirection;
};

template <class Law, class Forcing, class Pair, class Blades>
struct MotionPhases {
  template <class System>
  using Of = modes::ContactPhase<System, Law, Pair, Blades>;
  template <bool kOccurs, class Type>
  using If = std::conditional_t<kOccurs, Type, std::monostate>;

  // Only blades that bend carry a parameter, and start with a force.
  using Carried = If<Law::kHasBending, Of<modes::CarriedContact<Law, Forcing, Blades>>>;
  using Skimming = If<Law::kHasBending, Of<modes::SkimmingContact<Law, Forcing, Blades>>>;
  // Only tips that can stick have a right-hand side for it, and one that is asked whether they do.
  using Judge = If<contact::Sticks<Law>, modes::StickingSystem<Law, Forcing, Blades>>;
  using Sticking = If<contact::Sticks<Law>, Of<Judge>>;
  // Where slip reversals accumulate a tip comes to rest.
  using RestingLaw = typename contact::RestingLawOf<Law>::Type;
  static constexpr bool kRests = !std::is_void_v<RestingLaw>;
  using RestingSystem = typename RestingPhases<RestingLaw, Forcing, Pair, Blades>::System;
  using Resting = typename RestingPhases<RestingLaw, Forcing, Pair, Blades>::Phase;
  // Blades with two unknowns carry them; only a ring without mass is to be put somewhere.
  static constexpr bool kBends = HasTwoUnknowns<typename Law::OfBlade>;
  using SolvedSystem = std::conditional_t<
      kBends, modes::CarriedBends<Law, Forcing, Blades>,
      std::conditional_t<rotor::kRingFollows<Forcing>, modes::ContactsOnFollowingRing<Law, Forcing, Blades>,
                         modes::SolvedContacts<Law, Forcing, Blades>>>;
  using Solved = Of<SolvedSystem>;
  using RingPlacer = If<rotor::kRingFollows<Forcing>, SolvedSystem>;
};

}  // namespace rubatlas::motion

/// Which modes a motion has, by its law of contact and by what moves: none is compiled that cannot occur.
///
/// `ModesOf` is specialised once for each kind of law, in `modes_of_<kind>.hpp`; a source includes those of
/// the laws that it compiles, and of no other kind does it see the modes.
#pragma once

#include "modes/contact_phase.hpp"
#include "motion/contact_reset.hpp"
#include "rotor/any_shaft.hpp"
#include "rotor/bodies.hpp"

namespace rubatlas::motion {

template <class Law, class Forcing, class Pair, class Blades>
struct ModesOf;

/// Machines of which collocation knows the equations.
template <class Forcing>
inline constexpr bool kCollocatesOn = false;
template <>
inline constexpr bool kCollocatesOn<rotor::AnyShaft> = true;
template <>
inline constexpr bool kCollocatesOn<rotor::WithRingBody<rotor::AnyShaft>> = true;

/// What all kinds have. A specialisation adds its mode for any contacts, `Solved`, and says which of the
/// other modes it has.
template <class Law, class Pair>
struct ModesOfAnyLaw {
  using Reset = ContactReset<typename Law::OfBlade>;
  template <class Mode>
  using Phase = modes::ContactPhase<Mode, Pair>;

  struct None;
  static constexpr bool kCollocates = false;  ///< contacts of few blades may be solved by collocation
  using Collocated = None;
  static constexpr bool kCarries = false;  ///< blades of which one is carried, or skims
  using Carried = None;
  using Skimming = None;
  static constexpr bool kSticks = false;  ///< tips that can stick; the mode also judges whether they do
  using Sticking = None;
  /// Tips that always slip and come to rest where their slip reversals accumulate, under another law.
  static constexpr bool kRests = false;
  using RestingLaw = None;
  using Resting = None;
  static constexpr bool kRingFollows = false;  ///< a ring without mass, which is to be put somewhere
  using FollowingRing = None;
};

}  // namespace rubatlas::motion

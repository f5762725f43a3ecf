/// Who judges which tips rest on the ring, and which slip.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "collocation/law.hpp"
#include "collocation/tip_places.hpp"
#include "rotor/bodies.hpp"

namespace rubatlas::modes {

using collocation::Law;
using collocation::Standing;
using collocation::TipPlace;
using collocation::TipPlaces;

/// A contact that is open: which blade, its slip direction, and what its blade's equilibrium is found from,
/// all 0 where that is not known.
using OpenContact = collocation::Touch;
inline bool any_rests(std::span<const OpenContact> contacts) {
  return std::ranges::count(contacts, 0.0, &OpenContact::slip) > 0;
}

class RestJudge {
 public:
  virtual ~RestJudge() = default;

  /// Frees the tips at rest that friction cannot hold in a state. False where a tip is left neither rest nor
  /// a direction of slip (MODEL 5).
  virtual bool settle(const rotor::ContactState& state, std::vector<OpenContact>& contacts) = 0;
  // Of one of the contacts in a state:
  /// The slip velocity of its tip has come to zero: it rests or slips. False where it can do neither.
  virtual bool arrest(const rotor::ContactState& state, const std::vector<OpenContact>& contacts,
                      OpenContact& contact) = 0;
  /// Its tip at rest, which friction no longer holds, slips. False where it has no direction.
  virtual bool let_go(const rotor::ContactState& state, const std::vector<OpenContact>& contacts,
                      OpenContact& contact) = 0;
};

}  // namespace rubatlas::modes

#include "modes/rest_of_elastic_blades.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "collocation/inclined_law.hpp"
#include "contact/friction_law.hpp"
#include "contact/sticking_elastica.hpp"
#include "contact/tip.hpp"
#include "rotor/constants.hpp"

namespace rubatlas::modes {

const contact::DirectedElastica& RestOfElasticBlades::of(int blade) const {
  return static_cast<const collocation::InclinedLaw&>(*law_).of(blade);
}

bool RestOfElasticBlades::settle(const State& state, std::vector<OpenContact>& contacts) {
  for (OpenContact& contact : contacts) {
    if (contact.slip == 0.0) {
      if (!rests(contact, state) && !let_go(state, contacts, contact)) return false;
    } else if (may_open_at_rest(contact, state)) {
      OpenContact bent = contact;
      if (forward(bent, contact.slip, state) >= -slip_rounding(state)) continue;
      contact = bent;
      if (!arrest(state, contacts, contact)) return false;
    }
  }
  return true;
}

bool RestOfElasticBlades::come_to_rest(OpenContact& contact, const State& state) const {
  forward(contact, contact.slip, state);
  return rests(contact, state);
}

/// The direction in which a tip slips that rests no longer: that of the pull at the edge of the cone; where
/// its place is lost within the cone, the one with the larger s v, which is returned [m per unit τ].
double RestOfElasticBlades::leave_rest(OpenContact& contact, const State& state) const {
  constexpr double kAtTheEdge = 1e-6;  // of the cone
  const auto there = rest(contact, state);
  if (there && beyond_cone(contact, (1.0 + kAtTheEdge) * there->coefficient) > 0.0) {
    contact.slip = std::copysign(1.0, there->coefficient);
    return 0.0;
  }
  OpenContact ahead = contact;
  OpenContact back = contact;
  const double forwards = forward(ahead, 1.0, state);
  const double backwards = forward(back, -1.0, state);
  contact = forwards >= backwards ? ahead : back;
  return std::max(forwards, backwards);
}

/// Whether a contact is new and its tip may not slip in the direction s. One that opens unbent slips as the
/// undeformed tip does, of which s is the sign; where v vanishes nowhere on the ring that has the sign of
/// all.
bool RestOfElasticBlades::may_open_at_rest(const OpenContact& open, const State& state) const {
  const contact::DirectedElastica& law = of(open.blade);
  const contact::Pose at = pose(open.blade, state);
  const double speed = angular_speed(state);
  return open.bend.modulus == 0.0 && !law.opens_unbent(at, open.slip, speed) &&
         contact::resting_normal_angle(law.geometry(), at, speed, 0.0).has_value();
}
std::optional<RestOfElasticBlades::Rest> RestOfElasticBlades::rest(const OpenContact& open,
                                                                   const State& state) const {
  return of(open.blade).rest(pose(open.blade, state), angular_speed(state), open.bend);
}
double RestOfElasticBlades::looseness(const OpenContact& open, const std::optional<Rest>& there) const {
  constexpr double kLost = 1.0;
  if (!there) return kLost;
  const double least_modulus = contact::kLeastModulus * of(open.blade).friction().static_friction;
  return std::max({beyond_cone(open, there->coefficient), 1.0 - there->firmness / contact::kLeastFirmness,
                   1.0 - std::abs(there->bend.modulus) / least_modulus});
}
double RestOfElasticBlades::beyond_cone(const OpenContact& open, double coefficient) const {
  return std::abs(coefficient) - (1.0 + contact::kBeyondCone) * of(open.blade).friction().static_friction;
}

/// Puts a tip to rest where friction can hold it near its bend; false, and nothing changed, where not.
bool RestOfElasticBlades::rests(OpenContact& contact, const State& state) const {
  const auto there = rest(contact, state);
  if (looseness(contact, there) > 0.0) return false;
  contact.slip = 0.0;
  contact.bend = there->bend;
  return true;
}

/// s v [m per unit τ] of a contact that slips in the direction s, whose bend is updated; −∞ where it has no
/// equilibrium.
double RestOfElasticBlades::forward(OpenContact& contact, double slip, const State& state) const {
  contact::TipForce force{};
  contact.slip = slip;
  const bool stands = law_->respond(tip_place(contact.blade, state), contact, force);
  return stands ? slip * force.slip_velocity : -std::numeric_limits<double>::infinity();
}

bool RestOfElasticBlades::arrest(const State& state, const std::vector<OpenContact>& /*contacts*/,
                                 OpenContact& contact) {
  const double slip = contact.slip;
  if (come_to_rest(contact, state)) return true;
  // v that has been located as zero has any sign, the more so where friction hardly moves the tip.
  if (forward(contact, -slip, state) >= -slip_rounding(state)) return true;
  // Neither direction slips as it should: v may be zero next to the other one.
  return rests(contact, state);
}

bool RestOfElasticBlades::let_go(const State& state, const std::vector<OpenContact>& /*contacts*/,
                                 OpenContact& contact) {
  OpenContact there = contact;
  if (leave_rest(there, state) < -slip_rounding(state)) return rests(contact, state);
  contact = there;
  return true;
}

}  // namespace rubatlas::modes

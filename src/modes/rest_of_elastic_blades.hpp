/// Which tips of elastic blades rest on the ring.
///
/// The slip velocity of MODEL 4.4 is that of a rigid body through the place of the deformed tip. At a given
/// pose it is a function v(c) of the friction coefficient, through the blade's equilibrium, and Coulomb's
/// inclusion c ∈ μ Sign(v) is algebraic: a tip slips forward where v(μ) > 0, back where v(−μ) < 0, and rests
/// where v(c) = 0 in between. Its force is then a function of the pose alone (`DirectedElastica::rest`),
/// which joins those of the slipping tip without a jump where static and kinetic friction are equal; there is
/// no constraint to be put back on, and tips do not depend on each other.
///
/// A tip comes to rest only where v falls as c grows. Where it rises (the tip is pressed in) two slipping
/// states stand beside each other where v(μ) > 0 > v(−μ): a tip keeps its direction to the end of that state,
/// and then slips the other way, as in MODEL 4.4.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "collocation/inclined_law.hpp"
#include "contact/directed_elastica.hpp"
#include "contact/sticking_elastica.hpp"
#include "modes/rest_judge.hpp"
#include "rotor/bodies.hpp"

namespace rubatlas::modes {

/// A contact at rest is found from its bending and amplitude.
class RestOfElasticBlades : public RestJudge, public TipPlaces {
 public:
  using State = rotor::ContactState;
  using TipPlaces::TipPlaces;

  /// A contact that is new slips, or rests, as Coulomb's inclusion has it there.
  bool settle(const State& state, std::vector<OpenContact>& contacts) override {
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
  /// A slipping tip whose slip velocity has come to zero, or is against its direction: rests where it can,
  /// and slips the other way where it cannot.
  bool arrest(const State& state, const std::vector<OpenContact>& /*contacts*/,
              OpenContact& contact) override {
    const double slip = contact.slip;
    if (come_to_rest(contact, state)) return true;
    // v that has been located as zero has any sign, the more so where friction hardly moves the tip.
    if (forward(contact, -slip, state) >= -slip_rounding(state)) return true;
    // Neither direction slips as it should: v may be zero next to the other one.
    return rests(contact, state);
  }
  /// It slips the way it is pulled. Where neither direction is that of its v it has been let go a little
  /// early, and rests on; false, and nothing changed, where it does not.
  bool let_go(const State& state, const std::vector<OpenContact>& /*contacts*/,
              OpenContact& contact) override {
    OpenContact there = contact;
    if (leave_rest(there, state) < -slip_rounding(state)) return rests(contact, state);
    contact = there;
    return true;
  }
  /// Puts a slipping tip to rest where friction can hold it next to where it slips; false, and on where it
  /// slips, where not.
  bool come_to_rest(OpenContact& contact, const State& state) const {
    forward(contact, contact.slip, state);
    return rests(contact, state);
  }

  using Rest = contact::RestingBlade;
  [[nodiscard]] std::optional<Rest> rest(const OpenContact& open, const State& state) const {
    return of(open.blade).rest(pose(open.blade, state), angular_speed(state), open.bend);
  }
  /// |c| − μs [-], or how far a tip is from being firm, and its blade from being bent, at what `rest` has
  /// found: it comes loose where that is positive. One that nothing can hold has come loose.
  [[nodiscard]] double looseness(const OpenContact& open, const std::optional<Rest>& there) const {
    constexpr double kLost = 1.0;
    if (!there) return kLost;
    const double least_modulus = contact::kLeastModulus * of(open.blade).friction().static_friction;
    return std::max({beyond_cone(open, there->coefficient), 1.0 - there->firmness / contact::kLeastFirmness,
                     1.0 - std::abs(there->bend.modulus) / least_modulus});
  }

  /// The direction in which a tip slips that rests no longer: that of the pull at the edge of the cone; where
  /// its place is lost within the cone, the one with the larger s v, which is returned [m per unit τ].
  double leave_rest(OpenContact& contact, const State& state) const {
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

 private:
  [[nodiscard]] const contact::DirectedElastica& of(int blade) const {
    return static_cast<const collocation::InclinedLaw&>(*law_).of(blade);
  }
  /// Whether a contact is new and its tip may not slip in the direction s. One that opens unbent slips as the
  /// undeformed tip does, of which s is the sign; where v vanishes nowhere on the ring that has the sign of
  /// all.
  [[nodiscard]] bool may_open_at_rest(const OpenContact& open, const State& state) const {
    const contact::DirectedElastica& law = of(open.blade);
    const contact::Pose at = pose(open.blade, state);
    const double speed = angular_speed(state);
    return open.bend.modulus == 0.0 && !law.opens_unbent(at, open.slip, speed) &&
           contact::resting_normal_angle(law.geometry(), at, speed, 0.0).has_value();
  }
  [[nodiscard]] double beyond_cone(const OpenContact& open, double coefficient) const {
    return std::abs(coefficient) - (1.0 + contact::kBeyondCone) * of(open.blade).friction().static_friction;
  }
  /// Puts a tip to rest where friction can hold it near its bend; false, and nothing changed, where not.
  bool rests(OpenContact& contact, const State& state) const {
    const auto there = rest(contact, state);
    if (looseness(contact, there) > 0.0) return false;
    contact.slip = 0.0;
    contact.bend = there->bend;
    return true;
  }
  /// s v [m per unit τ] of a contact that slips in the direction s, whose bend is updated; −∞ where it has no
  /// equilibrium.
  double forward(OpenContact& contact, double slip, const State& state) const {
    contact::TipForce force{};
    contact.slip = slip;
    const bool stands = law_->respond(tip_place(contact.blade, state), contact, force);
    return stands ? slip * force.slip_velocity : -std::numeric_limits<double>::infinity();
  }
};

}  // namespace rubatlas::modes

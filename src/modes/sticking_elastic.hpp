/// Mode: elastic blades whose tips may stick to the ring.
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
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "contact/friction_law.hpp"
#include "contact/pose.hpp"
#include "contact/sticking_elastica.hpp"
#include "modes/guards.hpp"
#include "modes/law_of_inclined_loads.hpp"
#include "modes/open_contact.hpp"
#include "modes/rest_judge.hpp"
#include "modes/solved.hpp"
#include "rotor/constants.hpp"

namespace rubatlas::modes {

/// The equations of `Solved`. An open contact with slip 0 sticks, and is found from its bending and
/// amplitude.
class StickingElastic : public Solved, public RestJudge {
 public:
  using Solved::Solved;
  static constexpr bool kHasPath = false;

  /// A contact that is new slips, or rests, as Coulomb's inclusion has it there.
  bool settle(const FullState& state, std::vector<OpenContact>& contacts, const Tell& tell) override {
    for (OpenContact& contact : contacts) {
      if (contact.slip == 0.0) {
        if (rests(contact, state)) continue;
        if (!let_go(contact, state)) return false;
        tell(contact);
      } else if (contact.bend.modulus == 0.0 && !opens_unbent(contact, state) && may_rest(contact, state)) {
        OpenContact bent = contact;
        if (forward(bent, contact.slip, state) >= -rounding_of_slip(contact.blade)) continue;
        if (!arrest(contact = bent, state)) return false;
      }
    }
    return true;
  }

  /// A slipping tip whose slip velocity has come to zero, or is against its direction: rests where it can,
  /// and slips the other way where it cannot.
  bool arrest(const FullState& state, std::vector<OpenContact>& contacts, std::size_t contact) override {
    return arrest(contacts[contact], state);
  }
  /// Puts a slipping tip to rest where friction can hold it next to where it slips; false, and nothing
  /// changed, where not.
  bool come_to_rest(OpenContact& contact, const FullState& state) const {
    OpenContact there = contact;
    forward(there, contact.slip, state);
    if (!rests(there, state)) return false;
    contact = there;
    return true;
  }
  /// It slips the way it is pulled.
  bool let_go(const FullState& state, std::vector<OpenContact>& contacts, std::size_t contact) override {
    return let_go(contacts[contact], state);
  }

  /// |c| − μs [-], or how far a tip is from being firm, and its blade from being bent: it comes loose where
  /// that is positive. One that nothing can hold has come loose.
  [[nodiscard]] double excess(std::size_t contact, const FullState& state) const {
    if (is_stopped()) return -1.0;
    const OpenContact& open = contacts_[contact];
    const double result = looseness(open, rest(open, state));
    pay_curves();
    return result;
  }
  /// c [-] that holds a tip at rest, or under which it slips.
  [[nodiscard]] double friction_of(std::size_t contact, const contact::TipForce& force,
                                   const FullState& state) const {
    const OpenContact& open = contacts_[contact];
    if (open.slip != 0.0) return Solved::friction_of(contact, force, state);
    const auto there = rest(open, state);
    return there ? there->blade.coefficient : 0.0;
  }
  /// The force of tips that are all at rest is smooth.
  template <class Step>
  [[nodiscard]] double scaled_error(const Step& step) const {
    return error_of(step, acceleration_, all_at_rest(), [](const FullState&) { return 0.0; });
  }
  [[nodiscard]] ModeEnd without_force() const {
    // A tip at rest that nothing can hold beyond the start of the step.
    const OpenContact& lost = contacts_[lost_];
    if (lost.slip == 0.0) return {Guard::comes_loose, lost.blade};
    return Solved::without_force();
  }

  template <class Search>
  void guards(Search& search) const {
    guards_of_tips(*this, search);
  }

 protected:
  /// The direction in which a tip slips that rests no longer: that of the pull at the edge of the cone; where
  /// its place is lost within the cone, the one with the larger s v, which is returned [m per unit τ].
  double leave_rest(OpenContact& contact, const FullState& state) const {
    constexpr double kAtTheEdge = 1e-6;  // of the cone
    const auto there = rest(contact, state);
    if (there && beyond_cone(contact, (1.0 + kAtTheEdge) * there->blade.coefficient) > 0.0) {
      contact.slip = std::copysign(1.0, there->blade.coefficient);
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
    return static_cast<const LawOfInclinedLoads&>(*law_).of(blade);
  }

  /// Of μs, beyond which a tip comes loose. A tip comes to rest at the very edge of the cone, where its
  /// coefficient is known to some 1e-8: whether it rests must not depend on that.
  static constexpr double kShareBeyond = 1e-7;
  /// κ, of μs, below which the blade is a straight strut between hub and ring, as stiff as 1/κ², and about to
  /// leave the ring.
  static constexpr double kLeastModulus = 2e-4;

  /// Whether v vanishes anywhere on the ring. Where it does not the undeformed tip's has the sign of all.
  [[nodiscard]] bool may_rest(const OpenContact& open, const FullState& state) const {
    return contact::resting_normal_angle(law_->geometry(open.blade), pose(open.blade, state),
                                         blades().angular_speed(state[rotor::kTime]), 0.0)
        .has_value();
  }
  /// Its tip then slips as the undeformed tip does, of which s is the sign.
  [[nodiscard]] bool opens_unbent(const OpenContact& open, const FullState& state) const {
    return of(open.blade)
        .opens_unbent(pose(open.blade, state), open.slip, blades().angular_speed(state[rotor::kTime]));
  }
  using Rest = contact::DirectedElastica::Rest;
  [[nodiscard]] std::optional<Rest> rest(const OpenContact& open, const FullState& state) const {
    return of(open.blade)
        .rest(pose(open.blade, state), blades().angular_speed(state[rotor::kTime]), open.bend);
  }
  /// `excess` of a contact at what `rest` has found for it.
  [[nodiscard]] double looseness(const OpenContact& open, const std::optional<Rest>& there) const {
    constexpr double kLost = 1.0;
    if (!there) return kLost;
    const double least_modulus = kLeastModulus * of(open.blade).friction().static_friction;
    return std::max({beyond_cone(open, there->blade.coefficient),
                     1.0 - there->firmness / contact::kLeastFirmness,
                     1.0 - std::abs(there->blade.bend.modulus) / least_modulus});
  }
  [[nodiscard]] double rounding_of_slip(int blade) const {
    return contact::kSlipRounding * std::abs(rotor().speed_ratio) * law_->geometry(blade).ring_radius;
  }
  [[nodiscard]] double beyond_cone(const OpenContact& open, double coefficient) const {
    return std::abs(coefficient) - (1.0 + kShareBeyond) * of(open.blade).friction().static_friction;
  }

  /// Puts a tip to rest where friction can hold it near its bend; false, and nothing changed, where not.
  bool rests(OpenContact& contact, const FullState& state) const {
    const auto there = rest(contact, state);
    if (looseness(contact, there) > 0.0) return false;
    contact.slip = 0.0;
    contact.bend = there->blade.bend;
    return true;
  }

  /// s v [m per unit τ] of a contact that slips in the direction s, whose bend is updated; −∞ where it has no
  /// equilibrium.
  double forward(OpenContact& contact, double slip, const FullState& state) const {
    contact::TipForce force{};
    contact.slip = slip;
    const bool stands = law_->respond(place(contact.blade, state), contact, force);
    return stands ? slip * force.slip_velocity : -std::numeric_limits<double>::infinity();
  }

  bool arrest(OpenContact& contact, const FullState& state) const {
    OpenContact there = contact;
    forward(there, contact.slip, state);
    if (!rests(there, state)) {
      // v that has been located as zero has any sign, the more so where friction hardly moves the tip.
      const bool slips = forward(there, -contact.slip, state) >= -rounding_of_slip(contact.blade);
      // Neither direction slips as it should: v may be zero next to the other one.
      if (!slips && !rests(there, state)) return false;
    }
    contact = there;
    return true;
  }

  /// A tip that rests no longer slips. Where neither direction is that of its v it has been let go a little
  /// early, and rests on; false, and nothing changed, where it does not.
  bool let_go(OpenContact& contact, const FullState& state) const {
    OpenContact there = contact;
    if (leave_rest(there, state) < -rounding_of_slip(contact.blade)) return rests(contact, state);
    contact = there;
    return true;
  }
};

/// The same where slip reversals have accumulated under Coulomb's law (MODEL 4.4): the tips that slip beside
/// the one at rest reverse their slip at each zero of v, and nowhere else.
class Resting : public StickingElastic {
 public:
  using StickingElastic::StickingElastic;
  [[nodiscard]] static bool rests_at_once() { return false; }

  bool let_go(const FullState& state, std::vector<OpenContact>& contacts, std::size_t contact) override {
    leave_rest(contacts[contact], state);
    return true;
  }

  template <class Search>
  void guards(Search& search) const {
    guards_of_tips(*this, search);
  }
};

}  // namespace rubatlas::modes

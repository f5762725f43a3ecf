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

#include <optional>
#include <vector>

#include "contact/directed_elastica.hpp"
#include "modes/rest_judge.hpp"
#include "rotor/bodies.hpp"

namespace rubatlas::modes {

/// A contact at rest is found from its bending and amplitude.
class RestOfElasticBlades : public RestJudge, public TipPlaces {
 public:
  using State = rotor::ContactState;
  using TipPlaces::TipPlaces;

  /// A contact that is new slips, or rests, as Coulomb's inclusion has it there.
  bool settle(const State& state, std::vector<OpenContact>& contacts) override;
  /// A slipping tip whose slip velocity has come to zero, or is against its direction: rests where it can,
  /// and slips the other way where it cannot.
  bool arrest(const State& state, const std::vector<OpenContact>& contacts, OpenContact& contact) override;
  /// It slips the way it is pulled. Where neither direction is that of its v it has been let go a little
  /// early, and rests on; false, and nothing changed, where it does not.
  bool let_go(const State& state, const std::vector<OpenContact>& contacts, OpenContact& contact) override;
  /// Puts a slipping tip to rest where friction can hold it next to where it slips; false, and on where it
  /// slips, where not.
  bool come_to_rest(OpenContact& contact, const State& state) const;

  using Rest = contact::RestingBlade;
  [[nodiscard]] std::optional<Rest> rest(const OpenContact& open, const State& state) const;
  /// |c| − μs [-], or how far a tip is from being firm, and its blade from being bent, at what `rest` has
  /// found: it comes loose where that is positive. One that nothing can hold has come loose.
  [[nodiscard]] double looseness(const OpenContact& open, const std::optional<Rest>& there) const;

  /// The tip slips the way it is pulled; how fast, where its place is lost within the cone.
  double leave_rest(OpenContact& contact, const State& state) const;

 private:
  [[nodiscard]] const contact::DirectedElastica& of(int blade) const;
  [[nodiscard]] bool may_open_at_rest(const OpenContact& open, const State& state) const;
  [[nodiscard]] double beyond_cone(const OpenContact& open, double coefficient) const;
  bool rests(OpenContact& contact, const State& state) const;
  double forward(OpenContact& contact, double slip, const State& state) const;
};

}  // namespace rubatlas::modes

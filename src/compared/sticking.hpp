/// Mode: rigid blades of which one or two rest on the ring (`modes/rest_of_rigid_blades.hpp`).
#pragma once

#include <cstddef>
#include <vector>

#include "compared/guards.hpp"
#include "compared/solved.hpp"
#include "contact/tip.hpp"
#include "modes/rest_of_rigid_blades.hpp"

namespace rubatlas::compared {

/// The equations of `Solved`, with the friction that holds the tips at rest: the open contacts with slip 0.
class Sticking : public Solved {
 public:
  explicit Sticking(const modes::ContactSetup& setup) : Solved(setup), rest_(*setup.machine, *setup.law) {}
  static constexpr bool kBendsFollowPath = false;

  bool operator()(const FullState& state, FullState& derivative) {
    rest_.hold(state, contacts_);
    return Solved::operator()(state, derivative);
  }

  /// A tip at rest comes loose where it is positive.
  [[nodiscard]] double excess(std::size_t contact, const FullState& state) const {
    return rest_.excess(state, held(contact, state));
  }
  [[nodiscard]] contact::TipForce force(std::size_t contact, const FullState& state) const {
    return law_->force(held(contact, state), tip_place(contacts_[contact].blade, state));
  }
  [[nodiscard]] double friction_of(std::size_t contact, const contact::TipForce& force,
                                   const FullState& state) const {
    return contacts_[contact].slip == 0.0 ? held(contact, state).holding
                                          : Solved::friction_of(contact, force, state);
  }

  /// Puts the tips at rest back to v = 0, the shortest way.
  void project(FullState& state) const {
    std::vector<int> at_rest;
    for (const modes::OpenContact& open : contacts_) {
      if (open.slip == 0.0) at_rest.push_back(open.blade);
    }
    rest_.bring_to_rest(at_rest, state);
  }
  void place(FullState& state) const { project(state); }
  template <class Step>
  [[nodiscard]] double scaled_error(const Step& step) const {
    return error_of(step, acceleration_, all_at_rest(), [](const FullState&) { return 0.0; });
  }

  template <class Search>
  void guards(Search& search) const {
    guards_of_tips(*this, search);
  }

 private:
  /// A contact in a state, with the friction that holds its tip.
  [[nodiscard]] modes::OpenContact held(std::size_t contact, const FullState& state) const {
    std::vector<modes::OpenContact> contacts = contacts_;
    rest_.hold(state, contacts);
    return contacts[contact];
  }

  modes::RestOfRigidBlades rest_;
};

}  // namespace rubatlas::compared

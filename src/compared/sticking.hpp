/// Mode: rigid blades of which one or two rest on the ring (`modes/rest_of_rigid_blades.hpp`).
#pragma once

#include <cstddef>

#include "compared/contact_mode.hpp"
#include "compared/guards.hpp"
#include "contact/pose.hpp"
#include "modes/rest_of_rigid_blades.hpp"

namespace rubatlas::compared {

/// σ = τ. An open contact with slip 0 rests.
class Sticking : public ContactMode<> {
 public:
  explicit Sticking(const modes::ContactSetup& setup) : ContactMode(setup), rest_(setup) {}

  bool operator()(const FullState& state, FullState& derivative) {
    ++evaluations_;
    acceleration_ = {rest_.balance(state, contacts_, forces_).acceleration, 0.0};
    derivative = rotor::full_state(rotor::rate_of(state, acceleration_), 1.0, 0.0);
    return true;
  }

  /// A tip at rest comes loose where it is positive.
  [[nodiscard]] double excess(std::size_t contact, const FullState& state) const {
    return rest_.at_rest(state, contacts_, contact).excess();
  }
  [[nodiscard]] contact::TipForce force(std::size_t contact, const FullState& state) const {
    return rest_.force(state, contacts_, contact);
  }
  [[nodiscard]] double friction_of(std::size_t contact, const contact::TipForce& force,
                                   const FullState& state) const {
    return contacts_[contact].slip == 0.0 ? rest_.at_rest(state, contacts_, contact).coefficient()
                                          : ContactMode::friction_of(contact, force, state);
  }

  void project(FullState& state) const { rest_.project(state, contacts_); }
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
  modes::RestOfRigidBlades rest_;
};

}  // namespace rubatlas::compared

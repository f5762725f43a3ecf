/// Mode: rigid blades of which one or two rest on the ring (`modes/rest_of_rigid_blades.hpp`).
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <span>

#include "compared/contact_mode.hpp"
#include "compared/guards.hpp"
#include "contact/sticking.hpp"
#include "contact/tip.hpp"
#include "modes/rest_of_rigid_blades.hpp"

namespace rubatlas::compared {

/// σ = τ. An open contact with slip 0 rests.
class Sticking : public ContactMode<> {
 public:
  explicit Sticking(const modes::ContactSetup& setup) : ContactMode(setup), rest_(setup) {}

  bool operator()(const FullState& state, FullState& derivative) {
    ++evaluations_;
    const modes::RestOfRigidBlades::Balance now = rest_.balance(state, contacts_);
    for (std::size_t i = 0; i < contacts_.size(); ++i) forces_[i] = rest_.slipping(contacts_[i], state).force;
    for (std::size_t i = 0; i < now.count; ++i) hold(now.at_rest[i], forces_[now.at_rest[i].contact]);
    acceleration_ = {now.acceleration, 0.0};
    derivative = rotor::full_state(rotor::rate_of(state, acceleration_), 1.0, 0.0);
    return true;
  }

  /// A tip at rest comes loose where it is positive.
  [[nodiscard]] double excess(std::size_t contact, const FullState& state) const {
    return rest_.at_rest(state, contacts_, contacts_[contact]).excess();
  }
  [[nodiscard]] contact::TipForce force(std::size_t contact, const FullState& state) const {
    const modes::OpenContact& open = contacts_[contact];
    contact::TipForce result = rest_.slipping(open, state).force;
    if (open.slip == 0.0) hold(rest_.at_rest(state, contacts_, open), result);
    return result;
  }
  [[nodiscard]] double friction_of(std::size_t contact, const contact::TipForce& force,
                                   const FullState& state) const {
    return contacts_[contact].slip == 0.0 ? rest_.at_rest(state, contacts_, contacts_[contact]).coefficient()
                                          : ContactMode::friction_of(contact, force, state);
  }

  /// Puts the tips at rest back to v = 0, the shortest way.
  void project(FullState& state) const {
    std::array<contact::AtRest, contact::kMostAtRest> tips{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      if (contacts_[i].slip != 0.0) continue;
      const auto at = rest_.slipping(contacts_[i], state);
      tips[count++] = {rest_.at_rest(contacts_, i, at).tangent, at.force.slip_velocity};
    }
    contact::share_out(std::span(tips.data(), count));
    for (const contact::AtRest& tip : std::span(tips.data(), count)) {
      state[2] -= (tip.pull * tip.tangent).real();
      state[3] -= (tip.pull * tip.tangent).imag();
    }
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
  /// Adds the friction that holds a tip to the force of its contact.
  void hold(const modes::RestOfRigidBlades::AtRest& tip, contact::TipForce& force) const {
    const std::complex<double> friction =
        -tip.pull / rotor().force_unit * tip.tangent * std::conj(tip.direction);
    force.radial += friction.real();
    force.tangential += friction.imag();
  }

  modes::RestOfRigidBlades rest_;
};

}  // namespace rubatlas::compared

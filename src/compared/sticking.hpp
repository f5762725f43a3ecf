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

/// What tips at rest do, and how they are kept there.
class HeldTips final : public modes::RestOfRigidBlades {
 public:
  using RestOfRigidBlades::RestOfRigidBlades;

  /// What a contact does in a state.
  [[nodiscard]] contact::TipForce force(const State& state, Contacts contacts, std::size_t contact) const {
    contact::TipForce result = slipping(contacts[contact], state).force;
    if (contacts[contact].slip == 0.0)
      hold(RestOfRigidBlades::at_rest(state, contacts, contacts[contact]), result);
    return result;
  }
  /// The acceleration z''; sets the forces of all contacts.
  [[nodiscard]] std::complex<double> balance(const State& state, Contacts contacts,
                                             std::span<contact::TipForce> forces) const {
    const Balance now = RestOfRigidBlades::balance(state, contacts);
    for (std::size_t i = 0; i < contacts.size(); ++i) forces[i] = slipping(contacts[i], state).force;
    for (std::size_t i = 0; i < now.count; ++i) hold(now.at_rest[i], forces[now.at_rest[i].contact]);
    return now.acceleration;
  }
  /// Puts the tips at rest of a state back to v = 0, the shortest way.
  void project(State& state, Contacts contacts) const {
    std::array<AtRest, contact::kMostAtRest> tips{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (contacts[i].slip != 0.0) continue;
      tips[count] = RestOfRigidBlades::at_rest(contacts, i, slipping(contacts[i], state));
      tips[count].pull = tips[count].slip_velocity;
      ++count;
    }
    contact::share_out(std::span(tips.data(), count));
    for (const AtRest& tip : std::span(tips.data(), count)) {
      state[2] -= (tip.pull * tip.tangent).real();
      state[3] -= (tip.pull * tip.tangent).imag();
    }
  }

 private:
  /// Adds the friction that holds a tip to the force of its contact.
  void hold(const AtRest& tip, contact::TipForce& force) const {
    const std::complex<double> friction =
        -tip.pull / rotor().force_unit * tip.tangent * std::conj(tip.direction);
    force.radial += friction.real();
    force.tangential += friction.imag();
  }
};

/// σ = τ. An open contact with slip 0 rests.
class Sticking : public ContactMode<> {
 public:
  explicit Sticking(const modes::ContactSetup& setup) : ContactMode(setup), rest_(setup) {}

  bool operator()(const FullState& state, FullState& derivative) {
    ++evaluations_;
    acceleration_ = {rest_.balance(state, contacts_, forces_), 0.0};
    derivative = rotor::full_state(rotor::rate_of(state, acceleration_), 1.0, 0.0);
    return true;
  }

  /// A tip at rest comes loose where it is positive.
  [[nodiscard]] double excess(std::size_t contact, const FullState& state) const {
    return rest_.at_rest(state, contacts_, contacts_[contact]).excess();
  }
  [[nodiscard]] contact::TipForce force(std::size_t contact, const FullState& state) const {
    return rest_.force(state, contacts_, contact);
  }
  [[nodiscard]] double friction_of(std::size_t contact, const contact::TipForce& force,
                                   const FullState& state) const {
    return contacts_[contact].slip == 0.0 ? rest_.at_rest(state, contacts_, contacts_[contact]).coefficient()
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
  HeldTips rest_;
};

}  // namespace rubatlas::compared

/// Mode: rigid blades of which one or two stick to the ring: the friction on a tip at rest is the one that
/// keeps it there.
///
/// The slip velocities v of the stuck tips stay zero, and dv/dτ of each is linear in the friction q = c F/(m
/// ωn²) at all of them (`contact/sticking.hpp`), so that q solves a system with the cosines between the
/// tangents. A tip comes loose where |c| > μs (Filippov's sliding mode on v = 0; with two tips, on the
/// intersection). No more than two can stick: with v = Ω (|r| − p·n), p the rotor's instantaneous centre, all
/// of them touch the ring where a tangent to it leads to p.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/pose.hpp"
#include "contact/sticking.hpp"
#include "modes/contact_mode.hpp"
#include "modes/guards.hpp"
#include "modes/law_of_rigid_blades.hpp"
#include "modes/open_contact.hpp"
#include "modes/rest_judge.hpp"
#include "rotor/constants.hpp"

namespace rubatlas::modes {

/// σ = τ. An open contact with slip 0 sticks.
class Sticking : public ContactMode<>, public RestJudge {
 public:
  using ContactMode::ContactMode;

  bool operator()(const FullState& state, FullState& derivative) {
    ++evaluations_;
    acceleration_ = {balance(state, forces_).acceleration, 0.0};
    derivative = rotor::full_state(rotor::rate_of(state, acceleration_), 1.0, 0.0);
    return true;
  }

  /// Of the contacts with s = 0 in a state, those stay at rest that friction can hold; the others get the
  /// direction in which they are pulled. A rigid tip can always do either: true.
  bool settle(const FullState& state, std::vector<OpenContact>& contacts, const Tell& tell) override {
    std::size_t stuck = 0;
    for (OpenContact& contact : contacts) {
      if (contact.slip == 0.0 && ++stuck > contact::kMostAtRest) contact.slip = 1.0;
    }
    if (stuck == 0) return true;
    while (true) {
      stand(contacts);
      const Balance now = balance(state, forces_);
      const Stuck* loosest = nullptr;
      for (std::size_t i = 0; i < now.count; ++i) {
        const Stuck& tip = now.stuck[i];
        if (tip.excess() <= 0.0) continue;
        if (loosest == nullptr || tip.excess() > loosest->excess()) loosest = &tip;
      }
      if (loosest == nullptr) return true;
      OpenContact& freed = contacts[loosest->contact];
      freed.slip = loosest->pull >= 0.0 ? 1.0 : -1.0;
      tell(freed);
    }
  }

  /// Where two tips stick already, a third passes through.
  bool arrest(const FullState& /*state*/, std::vector<OpenContact>& contacts, std::size_t contact) override {
    const auto stuck = std::ranges::count(contacts, 0.0, &OpenContact::slip);
    contacts[contact].slip =
        stuck >= static_cast<std::ptrdiff_t>(contact::kMostAtRest) ? -contacts[contact].slip : 0.0;
    return true;
  }
  /// It slips the way it is pulled.
  bool let_go(const FullState& state, std::vector<OpenContact>& contacts, std::size_t contact) override {
    stand(contacts);
    contacts[contact].slip = std::copysign(1.0, coefficient(contact, state));
    return true;
  }

  /// What friction has to give beyond what it can, |q| − μs F/(m ωn²) [m per unit τ²]: a stuck tip comes
  /// loose where it is positive.
  [[nodiscard]] double excess(std::size_t contact, const FullState& state) const {
    return stuck(contact, state).excess();
  }
  /// c [-] of a stuck tip.
  [[nodiscard]] double coefficient(std::size_t contact, const FullState& state) const {
    const Stuck tip = stuck(contact, state);
    return tip.pull / tip.load;
  }
  /// What a contact does in a state.
  [[nodiscard]] contact::TipForce force(std::size_t contact, const FullState& state) const {
    contact::TipForce result = slipping(contacts_[contact], state).force;
    if (contacts_[contact].slip == 0.0) hold(stuck(contact, state), result);
    return result;
  }

  [[nodiscard]] double friction_of(std::size_t contact, const contact::TipForce& force,
                                   const FullState& state) const {
    return contacts_[contact].slip == 0.0 ? coefficient(contact, state)
                                          : ContactMode::friction_of(contact, force, state);
  }

  /// Puts the stuck tips of a state back to v = 0, the shortest way.
  void project(FullState& state) const {
    std::array<Stuck, contact::kMostAtRest> tips{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      if (contacts_[i].slip != 0.0) continue;
      tips[count] = tip_at_rest(i, slipping(contacts_[i], state));
      tips[count].pull = tips[count].slip_velocity;
      ++count;
    }
    std::complex<double> velocity(state[2], state[3]);
    contact::share_out(std::span(tips.data(), count));
    for (const Stuck& tip : std::span(tips.data(), count)) velocity -= tip.pull * tip.tangent;
    state[2] = velocity.real();
    state[3] = velocity.imag();
  }

  template <class Step>
  [[nodiscard]] double scaled_error(const Step& step) const {
    return error_of(step, acceleration_, all_at_rest(), [](const FullState&) { return 0.0; });
  }
  void place(FullState& state) const { project(state); }

  template <class Search>
  void guards(Search& search) const {
    guards_of_tips(*this, search);
  }

 private:
  struct Stuck {
    std::size_t contact = 0;
    std::complex<double> direction;  ///< er
    std::complex<double> tangent;    ///< t
    contact::Pose pose{};
    double load = 0.0;           ///< F/(m ωn²) [m per unit τ²]
    double largest = 0.0;        ///< μs [-]
    double slip_velocity = 0.0;  ///< v [m per unit τ]
    double pull = 0.0;  ///< q [m per unit τ²]: dv/dτ without friction at the tips at rest, then shared out
    [[nodiscard]] double excess() const {
      return std::abs(pull) - (1.0 + contact::kShareBeyondCone) * largest * load;
    }
  };
  struct Balance {
    std::complex<double> acceleration;  ///< z''
    std::array<Stuck, contact::kMostAtRest> stuck{};
    std::size_t count = 0;
  };
  /// A contact under the friction of its slip, of which a stuck one has none.
  struct Slipping {
    contact::BladeDirection direction;
    contact::Pose pose;
    contact::TipForce force;
  };

  [[nodiscard]] Slipping slipping(OpenContact contact, const FullState& state) const {
    Slipping result{};
    result.direction = blades().direction(contact.blade, blades().first(state[rotor::kTime]));
    result.pose = rotor::pose_of(rotor(), law_->geometry(contact.blade), result.direction, state.head<4>());
    law_->respond({result.pose, blades().angular_speed(state[rotor::kTime])}, contact, result.force);
    return result;
  }

  [[nodiscard]] Stuck tip_at_rest(std::size_t contact, const Slipping& at) const {
    const contact::ElasticRingContact& law =
        static_cast<const LawOfRigidBlades&>(*law_).of(contacts_[contact].blade);
    Stuck tip;
    tip.contact = contact;
    tip.direction = {at.direction.cosine, at.direction.sine};
    tip.tangent = tip.direction * contact::tangent(law.geometry(), at.pose);
    tip.pose = at.pose;
    tip.load = at.force.normal * rotor().force_unit;
    tip.largest = law.friction().static_friction;
    tip.slip_velocity = at.force.slip_velocity;
    return tip;
  }

  /// Forces on the rotor, those of the stuck tips worked out of the motion; `forces`, one a contact.
  [[nodiscard]] Balance balance(const FullState& state, std::span<contact::TipForce> forces) const {
    Balance result;
    std::complex<double> force;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const Slipping at = slipping(contacts_[i], state);
      force += std::complex<double>(at.force.radial, at.force.tangential) *
               std::complex<double>(at.direction.cosine, at.direction.sine);
      if (!forces.empty()) forces[i] = at.force;
      if (contacts_[i].slip == 0.0) result.stuck[result.count++] = tip_at_rest(i, at);
    }
    result.acceleration = machine().acceleration(state, force).shaft;
    const std::span<Stuck> stuck(result.stuck.data(), result.count);
    for (Stuck& tip : stuck) {
      const contact::Geometry& geometry = law_->geometry(contacts_[tip.contact].blade);
      const std::complex<double> seen = result.acceleration * std::conj(tip.direction);
      contact::OtherAcceleration other{seen.real(), seen.imag()};
      // The hub's own angular acceleration moves the tip across the blade.
      other.tangential += geometry.reach * blades().angular_acceleration(state[rotor::kTime]);
      tip.pull = contact::slip_acceleration(geometry, tip.pose, blades().angular_speed(state[rotor::kTime]),
                                            other, tip.load, 0.0);
    }
    contact::share_out(stuck);
    for (const Stuck& tip : stuck) {
      result.acceleration -= tip.pull * tip.tangent;
      if (!forces.empty()) hold(tip, forces[tip.contact]);
    }
    return result;
  }

  /// Adds the friction that holds a tip to the force of its contact.
  void hold(const Stuck& tip, contact::TipForce& force) const {
    const std::complex<double> friction =
        -tip.pull / rotor().force_unit * tip.tangent * std::conj(tip.direction);
    force.radial += friction.real();
    force.tangential += friction.imag();
  }

  [[nodiscard]] Stuck stuck(std::size_t contact, const FullState& state) const {
    const Balance now = balance(state, {});
    return now.count == 2 && now.stuck[1].contact == contact ? now.stuck[1] : now.stuck[0];
  }
};

}  // namespace rubatlas::modes

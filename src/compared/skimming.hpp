/// Mode: a tip that skims the ring (`rotor/skimming.hpp`), that of the first contact: at λ = 0 it leaves the
/// ring, at λ = 1 it is pressed in. The others bear their full force.
#pragma once

#include <complex>
#include <cstddef>
#include <limits>
#include <optional>

#include "compared/guards.hpp"
#include "compared/solved.hpp"
#include "contact/tip.hpp"
#include "rotor/skimming.hpp"

namespace rubatlas::compared {

class Skimming : public Solved {
 public:
  explicit Skimming(const modes::ContactSetup& setup) : Solved(setup) {}
  static constexpr bool kBendsFollowPath = false;

  bool operator()(const FullState& state, FullState& derivative) {
    ++evaluations_;
    const contact::BladeDirection first = blades().first(state[rotor::kTime]);
    std::complex<double> others;
    for (std::size_t i = 1; i < contacts_.size(); ++i) {
      if (!add_force(state, first, i, others)) return false;
    }
    const auto balance = weigh(state, contacts_.front(), others);
    if (!balance) return false;
    forces_.front() = balance->force;
    set_derivative(state, others + balance->share * balance->pushed, derivative);
    watch_shortening(shortening());
    return true;
  }

  /// λ in a state; NaN where a blade has no force.
  [[nodiscard]] double share(const FullState& state) const {
    const auto balance = balance_in(state);
    return balance ? balance->share : std::numeric_limits<double>::quiet_NaN();
  }
  /// λ times what the blade that skims does in full; nothing where a blade has no force.
  [[nodiscard]] contact::TipForce force(std::size_t contact, const FullState& state) const {
    if (contact > 0) return Solved::force(contact, state);
    const auto balance = balance_in(state);
    return balance ? balance->force : contact::TipForce{};
  }

  void project(FullState& state) const {
    const int skims = contacts_.front().blade;
    rotor::put_on_ring(machine(), law_->geometry(skims), direction(skims, state),
                       blades().angular_speed(state[rotor::kTime]), state);
  }

  template <class Step>
  [[nodiscard]] double scaled_error(const Step& step) const {
    const bool alone = contacts_.size() == 1;
    return error_of(step, acceleration_, alone, [](const FullState&) { return 0.0; });
  }

  /// The tip leaves the ring at λ = 0 and is pressed in at λ = 1; both by so much that rounding does not lead
  /// it back.
  template <class Search>
  void guards(Search& search) {
    const int skims = contacts_.front().blade;
    const auto at = [&](double part) { return share(search.step().at_fraction(part)); };
    search.look_for([&](double part) { return -kShareBeyond - at(part); }, {modes::Guard::lift_off, skims});
    search.look_for([&](double part) { return at(part) - (1.0 + kShareBeyond); },
                    {modes::Guard::pressed_in, skims});
    guards_but_of(skims, search);
  }

 private:
  static constexpr double kShareBeyond = 1e-9;  ///< of λ past 0 or 1

  /// Free motion against the blade's full force.
  struct Balance {
    std::complex<double> pushed;  ///< its full force on the rotor [N]
    double share;                 ///< λ
    contact::TipForce force;      ///< λ times the force
  };
  /// Of a contact, where the others push the rotor so [N]; none where it has no force.
  [[nodiscard]] std::optional<Balance> weigh(const FullState& state, modes::OpenContact& contact,
                                             const std::complex<double>& others) const {
    const contact::Geometry& geometry = law_->geometry(contact.blade);
    const contact::BladeDirection er = direction(contact.blade, state);
    const contact::Pose at = pose(contact.blade, state, er);
    contact::TipForce force{};
    contact::Pose on_ring = at;
    on_ring.gap = 0.0;  // what rounding leaves of it would bend a blade of hardly any friction
    if (!law_->respond({on_ring, angular_speed(state)}, contact, force)) return std::nullopt;
    const double share = rotor::skimming_share(machine(), geometry, er, at, state, others, force);
    return Balance{contact::on_rotor(force, er), share, rotor::share_of(force, share)};
  }
  [[nodiscard]] std::optional<Balance> balance_in(const FullState& state) const {
    std::complex<double> others;
    for (std::size_t i = 1; i < contacts_.size(); ++i) {
      modes::OpenContact open = contacts_[i];
      contact::TipForce force{};
      if (!law_->respond(tip_place(open.blade, state), open, force)) return std::nullopt;
      others += contact::on_rotor(force, direction(open.blade, state));
    }
    modes::OpenContact contact = contacts_.front();
    return weigh(state, contact, others);
  }
};

}  // namespace rubatlas::compared

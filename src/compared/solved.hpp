/// Mode: any blades in contact, each with its force found where it stands; σ = τ.
///
/// The form for every law, and the only one for rigid blades on an elastic ring, whose force follows from the
/// gap in closed form. For elastic blades the force is a root of h = 0 (MODEL 4.1), found from the last one.
#pragma once

#include <algorithm>
#include <complex>
#include <cstddef>

#include "compared/contact_mode.hpp"
#include "compared/guards.hpp"
#include "contact/tip.hpp"
#include "rotor/bodies.hpp"

namespace rubatlas::compared {

class Solved : public ContactMode<> {
 public:
  using ContactMode::ContactMode;
  static constexpr bool kBendsFollowPath = true;

  bool operator()(const FullState& state, FullState& derivative) {
    ++evaluations_;
    const contact::BladeDirection first = blades().first(state[rotor::kTime]);
    std::complex<double> force;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      if (!add_force(state, first, i, force)) return false;
    }
    set_derivative(state, force, derivative);
    if (!kind_.load_follows_gap()) watch_shortening(shortening());
    return true;
  }

  /// No step, however short, finds a force: the branch on which a blade stands has come to its end.
  [[nodiscard]] ModeEnd without_force() const { return kind_.without_force(contacts_[lost_].blade); }

  template <class Search>
  void guards(Search& search) {
    guards_but_of(kNone, search);
  }

 protected:
  static constexpr int kNone = -1;

  /// A blade whose touch-down or lift-off is not looked for has its own guards.
  template <class Search>
  void guards_but_of(int blade, Search& search) {
    const FullState& end = search.step().end();
    for (int k = 0; k < search.blades(); ++k) {
      if (!search.blade(k).open) {
        touch_down(*this, search, k);
      } else if (k != blade && ends_at_ring(k, end)) {
        lift_off_at_ring(*this, search, k);
      }
    }
    const Bounds range = bounds(search.step());
    for (std::size_t i = 0; i < contacts_.size(); ++i) slip_guard(*this, search, i, slip_lasts(range));
    loss_of_validity(*this, search, range.distance);
    for (std::size_t i = 0; kind_.has_branches() && i < contacts_.size(); ++i) buckling(*this, search, i);
  }

  /// Adds the force of a contact to that on the rotor [N]; blade 0 stands at `first`. False where there is
  /// none.
  bool add_force(const FullState& state, const contact::BladeDirection& first, std::size_t contact,
                 std::complex<double>& sum) {
    OpenContact& open = contacts_[contact];
    contact::TipForce& force = forces_[contact];
    const contact::BladeDirection er = blades().direction(open.blade, first);
    const contact::Pose pose =
        rotor::pose_of(rotor(), law_->geometry(open.blade), er, rotor::from_ring(state));
    const double side = open.bend.modulus;
    const bool found = respond_paid({pose, blades().angular_speed(state[rotor::kTime])}, open, force);
    if (!found || side * open.bend.modulus < 0.0) {
      lost_ = contact;
      return false;
    }
    sum += contact::on_rotor(force, er);
    return true;
  }
  void set_derivative(const FullState& state, const std::complex<double>& force, FullState& derivative) {
    acceleration_ = machine().acceleration(state, force);
    derivative = rotor::full_state(rotor::rate_of(state, acceleration_), 1.0, 0.0);
  }

  /// The contact that has found no force in the last evaluation that failed.
  std::size_t lost_ = 0;
};

}  // namespace rubatlas::compared

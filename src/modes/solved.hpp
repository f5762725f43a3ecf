/// Mode: any blades in contact, each with its force found where it stands; σ = τ.
///
/// The form for every law, and the only one for rigid blades on an elastic ring, whose force follows from the
/// gap in closed form. For elastic blades the force is a root of h = 0 (MODEL 4.1), found from the last one.
#pragma once

#include <algorithm>
#include <complex>
#include <cstddef>

#include "contact/pose.hpp"
#include "modes/contact_mode.hpp"
#include "modes/guards.hpp"
#include "modes/open_contact.hpp"
#include "rotor/bodies.hpp"

namespace rubatlas::modes {

template <class Law>
class Solved : public ContactMode<Law> {
 public:
  using Base = ContactMode<Law>;
  using Base::Base;
  using typename Base::FullState;
  static constexpr bool kHasPath = true;

  bool operator()(const FullState& state, FullState& derivative) {
    ++this->evaluations_;
    const contact::BladeDirection first = this->first_blade(state);
    std::complex<double> force;
    for (std::size_t i = 0; i < this->contacts_.size(); ++i) {
      if (!add_force(state, first, i, force)) return false;
    }
    set_derivative(state, force, derivative);
    if (!Law::kLoadFollowsGap) this->watch_shortening(this->shortening());
    return true;
  }

  /// No step, however short, finds a force: the branch on which a blade stands has come to its end.
  [[nodiscard]] ModeEnd without_force() const {
    const OpenContact& lost = this->contacts_[lost_];
    if constexpr (Law::kHasBending) {
      const auto& law = this->law_->of(lost.blade);
      if (law.has_branches()) return {Guard::snap, lost.blade};
      if (law.releases_at_fold()) return {Guard::lift_off, lost.blade};
    } else if (!Law::kLoadFollowsGap) {
      return {Guard::snap, lost.blade};
    }
    return Base::without_force();
  }

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
      } else if (k != blade && this->ends_at_ring(k, end)) {
        lift_off_at_ring(*this, search, k);
      }
    }
    const auto bounds = this->bounds(search.step());
    for (std::size_t i = 0; i < this->contacts_.size(); ++i)
      this->slip_guard(*this, search, i, this->slip_lasts(bounds));
    this->loss_of_validity(*this, search, bounds.distance);
    if constexpr (Law::kHasBending) {
      for (std::size_t i = 0; i < this->contacts_.size(); ++i) {
        if (this->law_->of(this->contacts_[i].blade).has_branches()) buckling(*this, search, i);
      }
    }
  }

  /// Adds the force of a contact to that on the rotor [N]; blade 0 stands at `first`. False where there is
  /// none.
  bool add_force(const FullState& state, const contact::BladeDirection& first, std::size_t contact,
                 std::complex<double>& sum) {
    OpenContact& open = this->contacts_[contact];
    contact::TipForce& force = this->forces_[contact];
    const contact::BladeDirection er = this->blades().direction(open.blade, first);
    const contact::Pose pose =
        rotor::pose_of(this->rotor(), this->law_->of(open.blade).geometry(), er, rotor::from_ring(state));
    const double side = open.bend.modulus;
    const bool found =
        this->respond_paid(pose, this->blades().angular_speed(state[rotor::kTime]), open, force);
    if (!found || side * open.bend.modulus < 0.0) {
      lost_ = contact;
      return false;
    }
    sum += contact::on_rotor(force, er);
    return true;
  }
  void set_derivative(const FullState& state, const std::complex<double>& force, FullState& derivative) {
    this->acceleration_ = this->machine().acceleration(state, force);
    derivative = rotor::full_state(rotor::rate_of(state, this->acceleration_), 1.0, 0.0);
  }

  /// The contact that has found no force in the last evaluation that failed.
  std::size_t lost_ = 0;
};

}  // namespace rubatlas::modes

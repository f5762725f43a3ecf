/// Modes: blades in contact with a massless ring that has a damper beside its spring under each tip.
///
/// A contact lasts as long as its force, F > 0 (`contact/damped_ring.hpp`). Rigid blades: F is explicit, and
/// vanishes while the tip is still inside the undeformed ring. Elastic blades: how far the ring yields, y, is
/// a state of each contact,
///     y' = (F − kr y) / cr,
/// and F vanishes where the tip leaves the circle R + y. After lift-off the tip moves inwards; the ring
/// creeps back behind it, and is met again where the tip turns outwards. A contact that opens inside starts
/// from there: y is the depth of the tip.
#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "collocation/damped_law.hpp"
#include "compared/contact_mode.hpp"
#include "compared/guards.hpp"
#include "compared/solved.hpp"
#include "contact/damped_ring.hpp"
#include "contact/tip.hpp"
#include "rotor/bodies.hpp"

namespace rubatlas::compared {

/// A blade that is not in contact touches: at g = 0, or, after a lift-off inside the ring, where it turns
/// outwards.
template <class Mode, class Search>
void touch_down_of_damped_ring(const Mode& mode, Search& search, int k) {
  const WatchedBlade& blade = search.blade(k);
  const bool inside = blade.at_start.value > mode.gap_rounding() && blade.at_start.rate <= 0.0;
  if (!inside) return touch_down(mode, search, k);
  // Outwards at any place outside of the ring is none: g rises through zero later, in a step of its own.
  const auto turns = [&](double part) {
    const BladeGap gap = mode.gap(k, search.step().at_fraction(part));
    return gap.value > 0.0 ? gap.rate : -std::abs(gap.rate);
  };
  search.look_between(turns, {-std::abs(blade.at_start.rate), turns(1.0)}, {Guard::touch_down, k});
}

template <class Mode, class Search>
void touch_downs_of_damped_ring(const Mode& mode, Search& search) {
  for (int k = 0; k < search.blades(); ++k) {
    if (!search.blade(k).open) touch_down_of_damped_ring(mode, search, k);
  }
}

/// Rigid blades.
class DampedRing : public Solved {
 public:
  using Solved::Solved;
  static constexpr bool kBendsFollowPath = false;

  template <class Search>
  void guards(Search& search) {
    touch_downs_of_damped_ring(*this, search);
    const Bounds range = bounds(search.step());
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const auto pull = [&](double part) { return -force(i, search.step().at_fraction(part)).normal; };
      search.look_for(pull, {Guard::lift_off, contacts_[i].blade});
      slip_guard(*this, search, i, slip_lasts(range));
    }
    shaft_at_ring(*this, search, range.distance);
  }
};

/// Elastic blades: (x, y, x', y', τ), and how far the ring yields under each contact.
class YieldingDampedRing : public ContactMode<rotor::BendsState> {
 public:
  using ContactMode::ContactMode;

  bool open(double time, const rotor::ShaftAndRing& bodies, const std::vector<OpenContact>& contacts,
            FullState& state) {
    stand(contacts);
    state.resize(rotor::kFirstBend + static_cast<Eigen::Index>(contacts.size()));
    state.head<4>() = bodies.head<4>();
    state[rotor::kTime] = time;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const int blade = contacts[i].blade;
      const bool is_new = contacts[i].bending == 0.0 && contacts[i].yielding == 0.0;
      state[place_of(i)] = is_new ? of(blade).depth(pose(blade, state)) : contacts[i].yielding;
    }
    return true;
  }

  bool operator()(const FullState& state, FullState& derivative) {
    ++evaluations_;
    const contact::BladeDirection first = blades().first(state[rotor::kTime]);
    derivative.resize(state.size());
    std::complex<double> force;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      double& rate = derivative[place_of(i)];
      if (!find_force(state, contacts_[i], state[place_of(i)], forces_[i], rate)) return false;
      force += contact::on_rotor(forces_[i], blades().direction(contacts_[i].blade, first));
    }
    acceleration_ = machine().acceleration(state, force);
    derivative.head<4>() = rotor::rate_of(state, acceleration_).head<4>();
    derivative[rotor::kTime] = 1.0;
    watch_shortening(shortening());
    return derivative.isFinite().all();
  }

  template <class Step>
  [[nodiscard]] double scaled_error(const Step& step) const {
    return error_of(step, acceleration_, false, [](const FullState& difference) {
      return difference.tail(difference.size() - rotor::kFirstBend).square().sum();
    });
  }
  [[nodiscard]] contact::TipForce force(std::size_t contact, const FullState& state) const {
    contact::TipForce force{};
    if (is_stopped()) return force;
    OpenContact guess = contacts_[contact];
    double rate = 0.0;
    find_force(state, guess, state[place_of(contact)], force, rate);
    return force;
  }
  [[nodiscard]] OpenContact contact_in(std::size_t contact, const FullState& state) const {
    OpenContact open = contacts_[contact];
    open.yielding = state[place_of(contact)];
    return open;
  }

  template <class Search>
  void guards(Search& search) {
    touch_downs_of_damped_ring(*this, search);
    const Bounds range = bounds(search.step());
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      if (contacts_[i].straight) {
        straight_guards(search, i);
      } else {
        leaves_circle(search, i);
      }
      slip_guard(*this, search, i, slip_lasts(range));
    }
    loss_of_validity(*this, search, range.distance);
  }

 private:
  [[nodiscard]] const contact::ElasticBladeOnDampedRing& of(int blade) const {
    return static_cast<const collocation::DampedLaw&>(*law_).of(blade);
  }
  [[nodiscard]] static Eigen::Index place_of(std::size_t contact) {
    return rotor::kFirstBend + static_cast<Eigen::Index>(contact);
  }
  /// The tip of a bent blade leaves the circle R + y.
  template <class Search>
  void leaves_circle(Search& search, std::size_t contact) {
    // A contact that has just opened stands there to rounding, and is pressed in.
    const auto outside = [&](double part) { return -gap_to_ring(contact, search.step().at_fraction(part)); };
    const double at_start = outside(0.0);
    const ModeEnd end{Guard::lift_off, contacts_[contact].blade};
    if (at_start >= -gap_rounding()) {
      search.look_from_zero([&](double part) { return outside(part) - at_start; }, outside(1.0) - at_start,
                            end);
    } else {
      search.look_between(outside, {at_start, outside(1.0)}, end, gap_rounding());
    }
  }
  /// The ring no longer pushes a straight blade, or pushes it enough to bend it.
  template <class Search>
  void straight_guards(Search& search, std::size_t contact) {
    const OpenContact& open = contacts_[contact];
    const auto load = [&](double part) { return force(contact, search.step().at_fraction(part)).normal; };
    const auto to_bend = [&](double part) {
      const FullState state = search.step().at_fraction(part);
      return of(open.blade)
          .bending_load(pose(open.blade, state), open.slip, blades().angular_speed(state[rotor::kTime]));
    };
    search.look_for([&](double part) { return -load(part); }, {Guard::lift_off, open.blade});
    search.look_for([&](double part) { return load(part) - to_bend(part); }, {Guard::pressed_in, open.blade});
  }

  /// |rk|² − (R + y)² [m²] of an open contact.
  [[nodiscard]] double gap_to_ring(std::size_t contact, const FullState& state) const {
    const OpenContact& open = contacts_[contact];
    return in_circle(open.blade, state, state[place_of(contact)]).gap;
  }
  /// Where a blade stands in the circle R + y.
  [[nodiscard]] contact::Pose in_circle(int blade, const FullState& state, double yielding) const {
    contact::Pose at = pose(blade, state);
    at.gap -= contact::widening(yielding, ring_radius());
    return at;
  }
  /// The force of a contact, and dy/dτ there. False where there is none.
  bool find_force(const FullState& state, OpenContact& open, double yielding, contact::TipForce& force,
                  double& rate) const {
    const contact::ElasticBladeOnDampedRing& law = of(open.blade);
    const double speed = blades().angular_speed(state[rotor::kTime]);
    if (open.straight) {
      force = law.straight().force(pose(open.blade, state), open.slip, speed);
      rate = law.yielding_rate(force.normal, yielding);
      return true;
    }
    const contact::Pose at = in_circle(open.blade, state, yielding);
    const bool found = law.respond(at, open.slip, speed, open.bending, force);
    rate = law.yielding_rate(force.normal, yielding);
    return pay_curves() && found;
  }
};

}  // namespace rubatlas::compared

/// Mode: rigid blades in a ring without mass, which all blades in contact push together: the ring stands
/// where its spring balances their forces (`rotor/ring_balance.hpp`).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "contact/pose.hpp"
#include "modes/solved.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"
#include "rotor/ring_balance.hpp"

namespace rubatlas::modes {

/// The equations of `Solved`, with the ring where its spring balances the blades. Place and velocity of the
/// ring are not degrees of freedom; they follow from the shaft's state.
template <class Law>
class FollowingRing : public Solved<Law> {
 public:
  using Base = Solved<Law>;
  using Base::Base;
  static constexpr bool kHasPath = false;
  using FullState = rotor::ContactState;

  bool operator()(const FullState& state, FullState& derivative) {
    FullState placed = state;
    return place_ring(placed) && Base::operator()(placed, derivative);
  }

  void project(FullState& state) const { place_ring(state); }
  void place(FullState& state) const { place_ring(state); }

  template <class Search>
  void guards(Search& search) {
    touch_downs_and_lift_offs(*this, search);
    // The rate of the ring does not tell how the ring moves on, so that no bound excludes these guards.
    for (std::size_t i = 0; i < this->contacts_.size(); ++i) this->slip_guard(*this, search, i, false);
    this->loss_of_validity(*this, search, std::numeric_limits<double>::infinity());
  }

  /// Puts the ring of a state where its spring balances the open contacts. False where there is no such place
  /// (MODEL 5).
  bool place_ring(FullState& state) const {
    return rotor::RingBalance(this->machine(), *this->law_, this->contacts()).place(state);
  }

  /// Finds the ring's place and the contacts together: `touches(blade)` opens the contact of a blade that
  /// reaches into the ring at its place, and the contact of a blade that does not is closed. (The place jumps
  /// where friction reverses.) False also where a tip would stick, since its friction would be another
  /// unknown (MODEL 5).
  template <class Touches>
  bool settle(rotor::ShaftAndRing& bodies, double time, std::vector<OpenContact>& contacts, Touches touches) {
    const double radius = this->law_->of(0).geometry().ring_radius;
    const double rounding = kGapRounding * radius * radius;
    for (int change = 0; change <= 2 * this->blades().count(); ++change) {
      FullState full;
      this->open(time, bodies, contacts, full);
      if (!place_ring(full)) return false;
      bodies = rotor::bodies(full);
      int enters = -1;
      double deepest = rounding;
      auto leaves = contacts.end();
      for (int k = 0; k < this->blades().count(); ++k) {
        const double gap = this->pose(k, full).gap;
        const auto open = std::ranges::find(contacts, k, &OpenContact::blade);
        if (open == contacts.end() && gap > deepest) {
          deepest = gap;
          enters = k;
        }
        if (open != contacts.end() && gap < -rounding) leaves = open;
      }
      if (leaves != contacts.end()) {
        contacts.erase(leaves);
      } else if (enters < 0) {
        return slides(full);
      } else if (!touches(enters)) {
        return false;
      }
    }
    return false;
  }

 private:
  /// Of R²: rounding of g where a touch-down or a lift-off has been located.
  static constexpr double kGapRounding = 32.0 * std::numeric_limits<double>::epsilon();

  /// All open contacts slip in the direction of their s.
  [[nodiscard]] bool slides(const FullState& state) const {
    const double speed = this->blades().angular_speed(state[rotor::kTime]);
    return std::ranges::all_of(this->contacts(), [&](const OpenContact& contact) {
      const contact::Geometry& geometry = this->law_->of(contact.blade).geometry();
      const double velocity =
          contact::undeformed_slip_velocity(geometry, this->pose(contact.blade, state), speed);
      return contact.slip * velocity >=
             -contact::kSlipRounding * std::abs(this->rotor().speed_ratio) * geometry.ring_radius;
    });
  }
};

}  // namespace rubatlas::modes

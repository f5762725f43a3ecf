/// Mode: rigid blades in a ring without mass, which all blades in contact push together: the ring stands
/// where its spring balances their forces (`rotor/ring_balance.hpp`).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "contact/pose.hpp"
#include "modes/law_of_rigid_blades.hpp"
#include "modes/solved.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"
#include "rotor/ring_balance.hpp"

namespace rubatlas::modes {

/// The equations of `Solved`, with the ring where its spring balances the blades. Place and velocity of the
/// ring are not degrees of freedom; they follow from the shaft's state.
class FollowingRing : public Solved {
 public:
  using Solved::Solved;
  static constexpr bool kHasPath = false;

  bool operator()(const FullState& state, FullState& derivative) {
    FullState placed = state;
    return place_ring(placed) && Solved::operator()(placed, derivative);
  }

  void project(FullState& state) const { place_ring(state); }
  void place(FullState& state) const { place_ring(state); }

  template <class Search>
  void guards(Search& search) {
    touch_downs_and_lift_offs(*this, search);
    // The rate of the ring does not tell how the ring moves on, so that no bound excludes these guards.
    for (std::size_t i = 0; i < contacts_.size(); ++i) slip_guard(*this, search, i, false);
    loss_of_validity(*this, search, std::numeric_limits<double>::infinity());
  }

  /// Puts the ring of a state where its spring balances the open contacts. False where there is no such place
  /// (MODEL 5).
  bool place_ring(FullState& state) const {
    return rotor::RingBalance(machine(), static_cast<const LawOfRigidBlades&>(*law_).blades(), contacts())
        .place(state);
  }

  /// Finds the ring's place and the contacts together: `touches(blade)` opens the contact of a blade that
  /// reaches into the ring at its place, and the contact of a blade that does not is closed. (The place jumps
  /// where friction reverses.) False also where a tip would stick, since its friction would be another
  /// unknown (MODEL 5).
  template <class Touches>
  bool settle(rotor::ShaftAndRing& bodies, double time, std::vector<OpenContact>& contacts, Touches touches) {
    const double radius = law_->geometry(0).ring_radius;
    const double rounding = kGapRounding * radius * radius;
    for (int change = 0; change <= 2 * blades().count(); ++change) {
      FullState full;
      open(time, bodies, contacts, full);
      if (!place_ring(full)) return false;
      bodies = rotor::bodies(full);
      int enters = -1;
      double deepest = rounding;
      auto leaves = contacts.end();
      for (int k = 0; k < blades().count(); ++k) {
        const double gap = pose(k, full).gap;
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
    const double speed = blades().angular_speed(state[rotor::kTime]);
    return std::ranges::all_of(contacts(), [&](const OpenContact& contact) {
      const contact::Geometry& geometry = law_->geometry(contact.blade);
      const double velocity = contact::undeformed_slip_velocity(geometry, pose(contact.blade, state), speed);
      return contact.slip * velocity >=
             -contact::kSlipRounding * std::abs(rotor().speed_ratio) * geometry.ring_radius;
    });
  }
};

}  // namespace rubatlas::modes

/// Mode: rigid blades in a ring without mass, which all blades in contact push together: the ring stands
/// where its spring balances their forces (`rotor/ring_balance.hpp`).
#pragma once

#include <cstddef>
#include <limits>

#include "compared/guards.hpp"
#include "compared/solved.hpp"

namespace rubatlas::compared {

/// The equations of `Solved`, with the ring where its spring balances the blades. Place and velocity of the
/// ring are not degrees of freedom; they follow from the shaft's state.
class FollowingRing : public Solved {
 public:
  using Solved::Solved;
  static constexpr bool kBendsFollowPath = false;

  bool operator()(const FullState& state, FullState& derivative) {
    FullState placed = state;
    return law_->place_ring(machine(), contacts_, placed) && Solved::operator()(placed, derivative);
  }

  void project(FullState& state) const { law_->place_ring(machine(), contacts_, state); }
  void place(FullState& state) const { project(state); }

  template <class Search>
  void guards(Search& search) {
    touch_downs_and_lift_offs(*this, search);
    // The rate of the ring does not tell how the ring moves on, so that no bound excludes these guards.
    for (std::size_t i = 0; i < contacts_.size(); ++i) slip_guard(*this, search, i, false);
    loss_of_validity(*this, search, std::numeric_limits<double>::infinity());
  }
};

}  // namespace rubatlas::compared

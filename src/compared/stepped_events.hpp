/// Where in a step something happens: sign changes of g and v between its ends, located on dense output
/// (what a general library for differential equations offers). What begins and ends within one step is not
/// seen: that is what a limit of the step is for.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "compared/stepped_system.hpp"
#include "contact/pose.hpp"
#include "integrate/root_between.hpp"
#include "modes/motion_listener.hpp"

namespace rubatlas::compared {

/// `horizon`: nothing happens.
struct SteppedEvent {
  modes::Guard kind = modes::Guard::horizon;
  std::size_t blade = 0;
  double fraction = 1.0;  ///< of the step
};

/// `before`: the blades as they were at the start of the step; the system's own are those of its end.
/// `state_at`: state at a fraction of the step.
template <class System, class StateAt>
SteppedEvent first_event(const System& system, const std::vector<SteppedBlade>& before, StateAt state_at) {
  // Where an event has been located g is zero to rounding: its sign is looked at a little later.
  constexpr double kJustAfter = 1e-6;  // of the step
  SteppedEvent first;
  const auto take = [&](modes::Guard kind, std::size_t blade, double fraction) {
    if (first.kind == modes::Guard::horizon || fraction < first.fraction) first = {kind, blade, fraction};
  };
  for (std::size_t k = 0; k < before.size(); ++k) {
    const SteppedBlade& after = system.blades()[k];
    const auto gap = [&](double part) { return system.pose(k, state_at(part)).gap; };
    if ((after.gap > 0.0) != before[k].open) {
      const double low = std::abs(before[k].gap) <= system.gap_rounding() ? kJustAfter : 0.0;
      take(before[k].open ? modes::Guard::lift_off : modes::Guard::touch_down, k,
           integrate::root_between(gap, low, 1.0, gap(low), after.gap));
    }
    if (!before[k].open) continue;
    const double from = before[k].slip_velocity;
    const double to = after.slip_velocity;
    if (from != 0.0 && (from > 0.0) != (to > 0.0)) {
      const auto velocity = [&](double part) { return system.force(k, state_at(part)).slip_velocity; };
      take(modes::Guard::slip_reversal, k, integrate::root_between(velocity, 0.0, 1.0, from, to));
    }
  }
  return first;
}

}  // namespace rubatlas::compared

/// Root of a function with a known slope between two points where it has opposite signs.
#pragma once

#include <cmath>

namespace rubatlas::integrate {

struct ValueAndSlope {
  double value;
  double slope;
};

/// The root by Newton's method from a guess between `low` and `high`, once a step is no longer than
/// `closeness`; its error then is of the second order of that. A step that would leave what the signs have
/// left of the interval halves it instead. `rises`: the function is negative at `low`. `function` returns a
/// `ValueAndSlope`.
template <class Function>
double newton_between(Function function, double low, double high, double guess, bool rises,
                      double closeness) {
  constexpr int kMostSteps = 100;
  double at = guess;
  for (int i = 0; i < kMostSteps; ++i) {
    const ValueAndSlope there = function(at);
    if (there.value == 0.0) return at;
    ((there.value < 0.0) == rises ? low : high) = at;
    double next = at - there.value / there.slope;
    // At the root rounding may leave a step none of what is between the signs.
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    const double step = std::abs(next - at);
    at = next;
    if (step <= closeness) break;
  }
  return at;
}

}  // namespace rubatlas::integrate

/// The supremum over continuous time of the shaft's distance from a point, on one piece of motion.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "integrate/root_between.hpp"
#include "observables/motion_piece.hpp"

namespace rubatlas::observables {

/// sup |(x, y − centre_y)| over the piece [m]. The piece is sampled at eighths of the fastest period (that of
/// the shaft or of the forcing; the square of the distance oscillates twice as fast). Between two samples the
/// distance has at most one maximum, where its rate changes sign; this maximum is located to the last digit.
inline double largest_distance(MotionPiece& piece, double centre_y, double speed_ratio) {
  const auto rate = [&](const State& state) {
    return state[0] * state[2] + (state[1] - centre_y) * state[3];
  };
  const auto distance = [&](const State& state) { return std::hypot(state[0], state[1] - centre_y); };
  const double length = piece.end() - piece.begin();
  const double spacing = 0.125 * std::numbers::pi / std::max(1.0, speed_ratio);
  const int intervals = std::max(1, static_cast<int>(std::ceil(length / spacing)));
  State before = piece.state(piece.begin());
  double time_before = piece.begin();
  double largest = distance(before);
  for (int i = 1; i <= intervals; ++i) {
    const double time = i == intervals ? piece.end() : piece.begin() + length * i / intervals;
    const State after = piece.state(time);
    largest = std::max(largest, distance(after));
    if (rate(before) > 0.0 && rate(after) < 0.0) {
      const double top = integrate::root_between([&](double t) { return rate(piece.state(t)); }, time_before,
                                                 time, rate(before), rate(after));
      largest = std::max(largest, distance(piece.state(top)));
    }
    before = after;
    time_before = time;
  }
  return largest;
}

}  // namespace rubatlas::observables

/// The supremum over continuous time of the shaft's distance from a point, on one piece of motion.
#pragma once

#include <algorithm>
#include <cmath>

#include "integrate/root_between.hpp"
#include "trajectory/motion_piece.hpp"

namespace rubatlas::trajectory {

/// sup |(x, y − centre_y)| over the piece [m]. Where the rate changes its sign between two samples the
/// maximum is located to the last digit.
inline double largest_distance(MotionPiece& piece, double centre_y, double speed_ratio) {
  const auto rate = [&](const State& state) {
    return state[0] * state[2] + (state[1] - centre_y) * state[3];
  };
  const auto distance = [&](const State& state) { return std::hypot(state[0], state[1] - centre_y); };
  const double length = piece.end() - piece.begin();
  const int intervals = std::max(1, static_cast<int>(std::ceil(length / spacing_of_distances(speed_ratio))));
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

}  // namespace rubatlas::trajectory

/// Shaft and ring at eight nodes of an interval, and vectors that turn.
#pragma once

#include <array>
#include <cstddef>

#include "collocation/interval.hpp"
#include "collocation/nodes_in_lanes.hpp"

namespace rubatlas::collocation {
namespace {

template <std::size_t kWidth>
struct VectorInLanes {
  Lanes<kWidth> x, y;
};

/// What turning a vector by an angle below 0.8 rad changes, by the series of sine and cosine: less than
/// 1e-16 of the angle is left out.
template <std::size_t kWidth>
VectorInLanes<kWidth> change_by_turning(const std::array<double, 2>& from, const Lanes<kWidth>& angle) {
  using Number = Lanes<kWidth>;
  const Number square = angle * angle;
  const Number fourth = square * square;
  const Number sine =
      angle * (((square * (-1.0 / 6) + 1.0) + fourth * (square * (-1.0 / 5040) + 1.0 / 120)) +
               (fourth * fourth) * ((square * (-1.0 / 39916800) + 1.0 / 362880) +
                                    fourth * (square * (-1.0 / 1307674368000.0) + 1.0 / 6227020800.0)));
  const Number cosine_less_one =
      square * (((square * (1.0 / 24) - 0.5) + fourth * (square * (1.0 / 40320) - 1.0 / 720)) +
                (fourth * fourth) * ((square * (1.0 / 479001600) - 1.0 / 3628800) +
                                     fourth * (square * (1.0 / 20922789888000.0) - 1.0 / 87178291200.0)));
  return {cosine_less_one * from[0] - sine * from[1], cosine_less_one * from[1] + sine * from[0]};
}
template <std::size_t kWidth>
VectorInLanes<kWidth> turned(const std::array<double, 2>& from, const Lanes<kWidth>& angle) {
  const VectorInLanes<kWidth> change = change_by_turning(from, angle);
  return {change.x + from[0], change.y + from[1]};
}

/// What turning a vector by a small angle changes: of angles below `kTurns` 1e-19 is left out, of those
/// below `kHardlyTurns`, by less than 1e-17, higher powers.
template <std::size_t kWidth>
struct TurnInLanes {
  using Number = Lanes<kWidth>;
  static constexpr double kTurns = 0.03;
  static constexpr double kHardlyTurns = 1e-3;
  Number sine, cosine_less_one;
  TurnInLanes(const Number& angle, bool hardly) {
    const Number square = angle * angle;
    if (hardly) {
      sine = angle * (square * (-1.0 / 6) + 1.0);
      cosine_less_one = square * (square * (1.0 / 24) - 0.5);
      return;
    }
    sine = angle * (square * (square * (square * (-1.0 / 5040) + 1.0 / 120) - 1.0 / 6) + 1.0);
    cosine_less_one = square * (square * (square * (square * (1.0 / 40320) - 1.0 / 720) + 1.0 / 24) - 0.5);
  }
  VectorInLanes<kWidth> operator()(const VectorInLanes<kWidth>& from) const {
    return {from.x * cosine_less_one - from.y * sine, from.y * cosine_less_one + from.x * sine};
  }
};

/// Shaft or ring at the nodes.
template <std::size_t kWidth>
struct BodyInLanes {
  using Number = Lanes<kWidth>;
  Number x, y;  ///< from where the interval starts [m]
  Number vx, vy, ax, ay;

  void start(const Body& body, bool warm, const Number& elapsed) {
    if (warm) {
      x = Number(body.x) - body.start[0];
      y = Number(body.y) - body.start[1];
      vx = Number(body.vx);
      vy = Number(body.vy);
      return;
    }
    const auto taylor = [&](std::size_t i, Number& place, Number& velocity) {
      const double acceleration = body.acceleration[i];
      const double jerk = body.jerk[i];
      velocity = elapsed * (elapsed * (0.5 * jerk) + acceleration) + body.start[2 + i];
      place = elapsed * (elapsed * (elapsed * (jerk * (1.0 / 6)) + 0.5 * acceleration) + body.start[2 + i]);
    };
    taylor(0, x, vx);
    taylor(1, y, vy);
  }
  /// Integrates the accelerations; `time_rate`: dτ/dθ. Returns the largest change of a velocity.
  double integrate(const Body& body, const NodeTables& nodes, const Number& time_rate) {
    const Number vx_next = Number::combined(nodes.integral, ax * time_rate) + body.start[2];
    const Number vy_next = Number::combined(nodes.integral, ay * time_rate) + body.start[3];
    x = Number::combined(nodes.integral, vx_next * time_rate);
    y = Number::combined(nodes.integral, vy_next * time_rate);
    const double change = larger(magnitude(vx_next - vx), magnitude(vy_next - vy)).largest();
    vx = vx_next;
    vy = vy_next;
    return change;
  }
  /// Moves the nodes on in τ.
  void go_on(const Number& time_step) {
    x = x + vx * time_step;
    y = y + vy * time_step;
    vx = vx + ax * time_step;
    vy = vy + ay * time_step;
  }
  /// Adds an acceleration.
  void add(const NodeTables& nodes, const Number& time_rate, const Number& more_x, const Number& more_y) {
    const auto to = [&](const Number& more, Number& place, Number& velocity, Number& acceleration) {
      const Number faster = Number::combined(nodes.integral, more * time_rate);
      acceleration = acceleration + more;
      velocity = velocity + faster;
      place = place + Number::combined(nodes.integral, faster * time_rate);
    };
    to(more_x, x, vx, ax);
    to(more_y, y, vy, ay);
  }
  /// Squares of Legendre's coefficients of the velocity's slope by θ.
  Number squares(const NodeTables& nodes, const Number& time_rate) const {
    const Number along_x = Number::combined(nodes.legendre, ax * time_rate);
    const Number along_y = Number::combined(nodes.legendre, ay * time_rate);
    return along_x * along_x + along_y * along_y;
  }
  VectorInLanes<kWidth> place(const Body& body) const { return {x + body.start[0], y + body.start[1]}; }
  void store(Body& body) const {
    const VectorInLanes<kWidth> there = place(body);
    there.x.store(body.x);
    there.y.store(body.y);
    vx.store(body.vx);
    vy.store(body.vy);
    ax.store(body.ax);
    ay.store(body.ay);
  }
};

}  // namespace
}  // namespace rubatlas::collocation

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
  using Number = Lanes<kWidth>;
  Number x, y;

  friend VectorInLanes operator+(const VectorInLanes& one, const VectorInLanes& other) {
    return {one.x + other.x, one.y + other.y};
  }
  friend VectorInLanes operator-(const VectorInLanes& one, const VectorInLanes& other) {
    return {one.x - other.x, one.y - other.y};
  }
  template <class Factor>
  friend VectorInLanes operator*(const VectorInLanes& vector, const Factor& factor) {
    return {vector.x * factor, vector.y * factor};
  }
  friend Number dot(const VectorInLanes& one, const VectorInLanes& other) {
    return one.x * other.x + one.y * other.y;
  }
  static VectorInLanes combined(const std::array<AtNodes, kNodes>& columns, const VectorInLanes& factors) {
    return {Number::combined(columns, factors.x), Number::combined(columns, factors.y)};
  }
  /// The largest magnitude of a component at a node.
  [[nodiscard]] double largest() const { return larger(magnitude(x), magnitude(y)).largest(); }
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

constexpr double kLittleTurn = 0.03;
constexpr double kHardlyATurn = 1e-3;
/// The same by a small angle: of angles below `kLittleTurn` 1e-19 is left out, of those below `kHardlyATurn`,
/// `hardly`, by less than 1e-17, higher powers.
template <std::size_t kWidth>
VectorInLanes<kWidth> change_by_little_turn(const VectorInLanes<kWidth>& from, const Lanes<kWidth>& angle,
                                            bool hardly) {
  const Lanes<kWidth> square = angle * angle;
  Lanes<kWidth> sine, cosine_less_one;
  if (hardly) {
    sine = angle * (square * (-1.0 / 6) + 1.0);
    cosine_less_one = square * (square * (1.0 / 24) - 0.5);
  } else {
    sine = angle * (square * (square * (square * (-1.0 / 5040) + 1.0 / 120) - 1.0 / 6) + 1.0);
    cosine_less_one = square * (square * (square * (square * (1.0 / 40320) - 1.0 / 720) + 1.0 / 24) - 0.5);
  }
  return {from.x * cosine_less_one - from.y * sine, from.y * cosine_less_one + from.x * sine};
}

/// Shaft or ring at the nodes.
template <std::size_t kWidth>
struct BodyInLanes {
  using Number = Lanes<kWidth>;
  using Vector = VectorInLanes<kWidth>;
  Vector displacement;  ///< from where the interval starts [m]
  Vector velocity, acceleration;

  void start(const Body& body, bool warm, const Number& elapsed) {
    if (warm) {
      displacement = {Number(body.x) - body.start[0], Number(body.y) - body.start[1]};
      velocity = {Number(body.vx), Number(body.vy)};
      return;
    }
    const auto taylor = [&](std::size_t i, Number& place, Number& speed) {
      const double first = body.at_start.acceleration[i];
      const double jerk = body.at_start.jerk[i];
      speed = elapsed * (elapsed * (0.5 * jerk) + first) + body.start[2 + i];
      place = elapsed * (elapsed * (elapsed * (jerk * (1.0 / 6)) + 0.5 * first) + body.start[2 + i]);
    };
    taylor(0, displacement.x, velocity.x);
    taylor(1, displacement.y, velocity.y);
  }
  /// Integrates the accelerations; `time_rate`: dτ/dθ. Returns the largest change of a velocity.
  double integrate(const Body& body, const NodeTables& nodes, const Number& time_rate) {
    const Vector next =
        Vector::combined(nodes.integral, acceleration * time_rate) + Vector{body.start[2], body.start[3]};
    displacement = Vector::combined(nodes.integral, next * time_rate);
    const double change = (next - velocity).largest();
    velocity = next;
    return change;
  }
  /// The accelerations that go with the velocities.
  void differentiate(const Body& body, const NodeTables& nodes, const Number& time_rate) {
    acceleration = Vector::combined(nodes.slope, velocity - Vector{body.start[2], body.start[3]}) *
                   (Number(1.0) / time_rate);
  }
  /// Moves the nodes on in τ.
  void go_on(const Number& time_step) {
    displacement = displacement + velocity * time_step;
    velocity = velocity + acceleration * time_step;
  }
  /// Adds an acceleration.
  void add(const NodeTables& nodes, const Number& time_rate, const Vector& more) {
    const Vector faster = Vector::combined(nodes.integral, more * time_rate);
    acceleration = acceleration + more;
    velocity = velocity + faster;
    displacement = displacement + Vector::combined(nodes.integral, faster * time_rate);
  }
  /// Squares of Legendre's coefficients of the velocity's slope by θ.
  Number squares(const NodeTables& nodes, const Number& time_rate) const {
    const Vector along = Vector::combined(nodes.legendre, acceleration * time_rate);
    return dot(along, along);
  }
  Vector place(const Body& body) const { return displacement + Vector{body.start[0], body.start[1]}; }
  void store(Body& body) const {
    const Vector there = place(body);
    there.x.store(body.x);
    there.y.store(body.y);
    velocity.x.store(body.vx);
    velocity.y.store(body.vy);
    acceleration.x.store(body.ax);
    acceleration.y.store(body.ay);
  }
};

}  // namespace
}  // namespace rubatlas::collocation

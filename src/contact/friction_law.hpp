/// Friction between blade tip and ring: the signed friction coefficient c(v), so that the ring pulls at the
/// tip with −c F along t (MODEL 4.3 has c = s μ).
///
/// v is the slip velocity of the tip [m per unit τ], s = ±1 the slip direction that the caller keeps as a
/// discrete state (MODEL 4.4). Coulomb's law takes its sign from s and is smooth between slip reversals; the
/// others take it from v, are smooth through v = 0, and have no slip reversal to locate.
#pragma once

#include <algorithm>
#include <cmath>

namespace rubatlas::contact {

// Functions of a `double`, or of eight nodes in lanes at once, made of sums and products alone, so that their
// bits are the same on every processor.

// What lanes have for themselves (`collocation/nodes_in_lanes.hpp`).
inline double smaller(double a, double b) {
  return std::min(a, b);
}
inline double magnitude(double a) {
  return std::abs(a);
}
inline double with_sign_of(double a, double b) {
  return std::copysign(a, b);
}

/// 1 − e^−x for x >= 0, with an error of less than 2e-15 of it. Beyond 40 it is 1 to the last bit.
///
/// The series at x/64, and six times y(2x) = y (2 − y), which loses no digits.
template <class Number>
Number decayed(const Number& x) {
  constexpr double kLargest = 40.0;
  constexpr int kDoublings = 6;
  const Number part = smaller(x, Number(kLargest)) * (1.0 / 64.0);
  constexpr int kTerms = 15;
  Number sum(1.0);
  for (int k = kTerms; k > 1; --k) sum = Number(1.0) - part * sum * (1.0 / k);
  Number result = part * sum;
  for (int i = 0; i < kDoublings; ++i) result = result * (Number(2.0) - result);
  return result;
}

/// tanh x, with an error of less than 2e-15 of it.
template <class Number>
Number hyperbolic_tangent(const Number& x) {
  // Of the same sign as x: x/|x| would be no number at 0.
  const Number decay = decayed(Number(magnitude(x) * 2.0));
  const Number size = decay / (Number(2.0) - decay);
  return with_sign_of(size, x);
}

/// A friction law of any kind, as numbers. Velocities are in metres per unit τ.
struct Friction {
  double friction;                     ///< μ, or the kinetic μk [-]
  double static_friction = 0.0;        ///< μs [-]: Stribeck's, or that of a tip at rest that sticks
  double stribeck_velocity = 0.0;      ///< vs of Stribeck's law, else 0
  double regularising_velocity = 0.0;  ///< v0; 0 of Coulomb's law
  bool sticks = false;                 ///< s = 0 is a tip at rest

  /// c = s μ (MODEL 4.3).
  static Friction coulomb(double friction) { return {friction}; }
  /// Coulomb's law with stick: a tip at rest is held by the friction coefficient that rest needs, up to the
  /// static one. This coefficient is found by the caller (`sticking.hpp`), or by the law of contact itself
  /// (`DirectedElastica`).
  static Friction sticking(double friction, double largest_holding) {
    return {.friction = friction, .static_friction = largest_holding, .sticks = true};
  }
  /// c = μ tanh(v/v0). Beyond |v| = 20 v0 it is Coulomb's law to the last bit; a tip that would stick creeps
  /// instead, at a speed below v0.
  /// Source: Andersson, Söderberg, Björklund, Tribology International 40 (2007) 580–587; Pennestrì et al.,
  /// Nonlinear Dynamics 83 (2016) 1785–1801.
  static Friction regularised(double friction, double regularising_velocity) {
    return {.friction = friction, .regularising_velocity = regularising_velocity};
  }
  /// c = [μk + (μs − μk) exp(−(v/vs)²)] tanh(v/v0): from the static coefficient it falls to the kinetic one
  /// as the slip grows, and goes through zero at v = 0 without a jump. Its largest value stays a little below
  /// μs; the difference vanishes with v0/vs.
  /// Source: Armstrong-Hélouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083–1138 (Stribeck curve with
  /// exponent 2), without the viscous term.
  static Friction stribeck(double static_friction, double kinetic_friction, double stribeck_velocity,
                           double regularising_velocity) {
    return {kinetic_friction, static_friction, stribeck_velocity, regularising_velocity};
  }

  /// Friction takes its sign from s. Else it depends on the slip velocity.
  [[nodiscard]] bool has_slip_state() const { return !(regularising_velocity > 0.0); }
  /// Bound of |c|.
  [[nodiscard]] double largest() const { return std::max(static_friction, friction); }
  /// c, and dc/dv [1/(m per unit τ)] at fixed s. `Number`: `double`, or eight nodes in lanes.
  template <class Number>
  struct At {
    Number coefficient, slope;
  };
  template <class Number>
  [[nodiscard]] At<Number> at(const Number& velocity, double slip) const {
    if (has_slip_state()) return {Number(slip * friction), Number(0.0)};
    const double per_velocity = 1.0 / regularising_velocity;
    const Number share = hyperbolic_tangent(velocity * per_velocity);
    const Number rise = (Number(1.0) - share * share) * per_velocity;
    if (!(stribeck_velocity > 0.0)) return {share * friction, rise * friction};
    const double excess = static_friction - friction;
    const Number ratio = velocity * (1.0 / stribeck_velocity);
    const Number more = (Number(1.0) - decayed(ratio * ratio)) * excess;
    const Number size = more + friction;
    return {size * share, size * rise - ratio * more * share * (2.0 / stribeck_velocity)};
  }
  [[nodiscard]] double coefficient(double velocity, double slip) const {
    return at(velocity, slip).coefficient;
  }
};

}  // namespace rubatlas::contact

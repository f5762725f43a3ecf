/// Friction between blade tip and ring: the signed friction coefficient c(v), so that the ring pulls at the
/// tip with −c F along t (MODEL 4.3 has c = s μ).
///
/// v is the slip velocity of the tip [m per unit τ], s = ±1 the slip direction that the caller keeps as a
/// discrete state (MODEL 4.4). Coulomb's law takes its sign from s and is smooth between slip reversals; the
/// others take it from v, are smooth through v = 0, and have no slip reversal to locate.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace rubatlas::contact {

/// A friction law of any kind, as numbers. Velocities are in metres per unit τ.
struct Friction {
  enum class Law : std::uint8_t { coulomb, regularised, stribeck };

  double friction;                     ///< μ, or the kinetic μk [-]
  double static_friction = 0.0;        ///< μs [-]: Stribeck's, or that of a tip at rest that sticks
  double stribeck_velocity = 0.0;      ///< vs
  double regularising_velocity = 0.0;  ///< v0
  Law law = Law::coulomb;
  bool sticks = false;  ///< s = 0 is a tip at rest

  /// c = s μ (MODEL 4.3).
  static Friction coulomb(double friction) { return {friction}; }
  /// Coulomb's law with stick: a tip at rest is held by the friction coefficient that rest needs, up to the
  /// static one. This coefficient is found by the caller (`sticking.hpp`), or by the law of contact itself
  /// (`DirectedElastica`).
  static Friction sticking(double friction, double largest_holding) {
    Friction result{friction, largest_holding};
    result.sticks = true;
    return result;
  }
  /// c = μ tanh(v/v0). Beyond |v| = 20 v0 it is Coulomb's law to the last bit; a tip that would stick creeps
  /// instead, at a speed below v0.
  /// Source: Andersson, Söderberg, Björklund, Tribology International 40 (2007) 580–587; Pennestrì et al.,
  /// Nonlinear Dynamics 83 (2016) 1785–1801.
  static Friction regularised(double friction, double regularising_velocity) {
    return {friction, 0.0, 0.0, regularising_velocity, Law::regularised};
  }
  /// c = [μk + (μs − μk) exp(−(v/vs)²)] tanh(v/v0): from the static coefficient it falls to the kinetic one
  /// as the slip grows, and goes through zero at v = 0 without a jump. Its largest value stays a little below
  /// μs; the difference vanishes with v0/vs.
  /// Source: Armstrong-Hélouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083–1138 (Stribeck curve with
  /// exponent 2), without the viscous term.
  static Friction stribeck(double static_friction, double kinetic_friction, double stribeck_velocity,
                           double regularising_velocity) {
    return {kinetic_friction, static_friction, stribeck_velocity, regularising_velocity, Law::stribeck};
  }

  /// Friction takes its sign from s. Else it depends on the slip velocity.
  [[nodiscard]] bool has_slip_state() const { return law == Law::coulomb; }
  [[nodiscard]] bool depends_on_velocity() const { return law != Law::coulomb; }
  /// Bound of |c|.
  [[nodiscard]] double largest() const { return std::max(static_friction, friction); }
  [[nodiscard]] double coefficient(double velocity, double slip) const {
    if (law == Law::coulomb) return slip * friction;
    return size(velocity) * std::tanh(velocity / regularising_velocity);
  }
  /// dc/dv [1/(m per unit τ)] at fixed s.
  [[nodiscard]] double slope(double velocity) const {
    if (law == Law::coulomb) return 0.0;
    const double share = std::tanh(velocity / regularising_velocity);
    if (law == Law::regularised) return friction / regularising_velocity * (1.0 - share * share);
    const double ratio = velocity / stribeck_velocity;
    return -2.0 * ratio / stribeck_velocity * excess(velocity) * share +
           size(velocity) * (1.0 - share * share) / regularising_velocity;
  }

 private:
  /// |c| where |v| is large against v0.
  [[nodiscard]] double size(double velocity) const {
    return law == Law::stribeck ? friction + excess(velocity) : friction;
  }
  [[nodiscard]] double excess(double velocity) const {
    const double ratio = velocity / stribeck_velocity;
    return (static_friction - friction) * std::exp(-ratio * ratio);
  }
};

}  // namespace rubatlas::contact

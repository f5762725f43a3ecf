/// Friction between blade tip and ring: the signed friction coefficient c(v), so that the ring pulls at the
/// tip with −c F along t (MODEL 4.3 has c = s μ).
///
/// v is the slip velocity of the tip [m per unit τ], s = ±1 the slip direction that the caller keeps as a
/// discrete state (MODEL 4.4). A law with `kHasSlipState` takes its sign from s and is smooth between slip
/// reversals; the others take it from v, are smooth through v = 0, and have no slip reversal to locate.
/// `slope` is dc/dv [1/(m per unit τ)] at fixed s.
#pragma once

#include <algorithm>
#include <cmath>
#include <variant>

namespace rubatlas::contact {

/// Coulomb's law, c = s μ (MODEL 4.3).
struct CoulombFriction {
  double friction;  ///< μ [-]

  static constexpr bool kHasSlipState = true;
  /// Does c depend on the slip velocity between reversals?
  static constexpr bool kDependsOnVelocity = false;
  /// Bound of |c|.
  [[nodiscard]] double largest() const { return friction; }
  [[nodiscard]] double coefficient(double /*velocity*/, double slip) const { return slip * friction; }
  [[nodiscard]] double slope(double /*velocity*/, double /*slip*/) const { return 0.0; }
};

/// Coulomb's law with stick: s = 0 is a tip at rest, held by the friction coefficient that rest needs, up to
/// the static one. This coefficient is found by the caller (`sticking.hpp`), or by the contact law itself
/// (`DirectedElastica`).
struct StickingFriction {
  double friction;         ///< μ of a tip that slips [-]
  double largest_holding;  ///< μs of a tip at rest [-]

  static constexpr bool kHasSlipState = true;
  static constexpr bool kDependsOnVelocity = false;
  [[nodiscard]] double largest() const { return largest_holding; }
  [[nodiscard]] double coefficient(double /*velocity*/, double slip) const { return slip * friction; }
  [[nodiscard]] double slope(double /*velocity*/, double /*slip*/) const { return 0.0; }
};

/// A contact law under which tips can stick.
template <class Law>
concept Sticks = requires(const Law& law) {
  law.of(0).friction().largest_holding;
};

/// Regularised Coulomb law, c = μ tanh(v/v0). Beyond |v| = 20 v0 it is Coulomb's law to the last bit; a tip
/// that would stick creeps instead, at a speed below v0.
/// Source: Andersson, Söderberg, Björklund, Tribology International 40 (2007) 580–587; Pennestrì
/// et al., Nonlinear Dynamics 83 (2016) 1785–1801.
struct RegularisedFriction {
  double friction;               ///< μ [-]
  double regularising_velocity;  ///< v0 [m per unit τ]

  static constexpr bool kHasSlipState = false;
  static constexpr bool kDependsOnVelocity = true;
  [[nodiscard]] double largest() const { return friction; }
  [[nodiscard]] double coefficient(double velocity, double /*slip*/) const {
    return friction * std::tanh(velocity / regularising_velocity);
  }
  [[nodiscard]] double slope(double velocity, double /*slip*/) const {
    const double share = std::tanh(velocity / regularising_velocity);
    return friction / regularising_velocity * (1.0 - share * share);
  }
};

/// Stribeck's law, c = [μk + (μs − μk) exp(−(v/vs)²)] tanh(v/v0): from the static coefficient it falls to the
/// kinetic one as the slip grows, and goes through zero at v = 0 without a jump. Its largest value stays a
/// little below μs; the difference vanishes with v0/vs.
/// Source: Armstrong-Hélouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083–1138 (Stribeck curve with
/// exponent 2), without the viscous term.
struct StribeckFriction {
  double static_friction;        ///< μs [-]
  double kinetic_friction;       ///< μk [-]
  double stribeck_velocity;      ///< vs [m per unit τ]
  double regularising_velocity;  ///< v0 [m per unit τ]

  static constexpr bool kHasSlipState = false;
  static constexpr bool kDependsOnVelocity = true;
  [[nodiscard]] double largest() const { return std::max(static_friction, kinetic_friction); }
  [[nodiscard]] double coefficient(double velocity, double /*slip*/) const {
    const double ratio = velocity / stribeck_velocity;
    return (kinetic_friction + (static_friction - kinetic_friction) * std::exp(-ratio * ratio)) *
           std::tanh(velocity / regularising_velocity);
  }
  [[nodiscard]] double slope(double velocity, double /*slip*/) const {
    const double ratio = velocity / stribeck_velocity;
    const double excess = (static_friction - kinetic_friction) * std::exp(-ratio * ratio);
    const double share = std::tanh(velocity / regularising_velocity);
    return -2.0 * ratio / stribeck_velocity * excess * share +
           (kinetic_friction + excess) * (1.0 - share * share) / regularising_velocity;
  }
};

/// A law that depends on the slip velocity, chosen at run time: a motion is compiled once for both.
class VelocityFriction {
 public:
  static constexpr bool kHasSlipState = false;
  static constexpr bool kDependsOnVelocity = true;

  explicit VelocityFriction(const RegularisedFriction& law) : law_(law) {}
  explicit VelocityFriction(const StribeckFriction& law) : law_(law) {}
  using Law = std::variant<RegularisedFriction, StribeckFriction>;
  [[nodiscard]] const Law& law() const { return law_; }
  [[nodiscard]] double largest() const {
    return std::visit([](const auto& law) { return law.largest(); }, law_);
  }
  [[nodiscard]] double coefficient(double velocity, double slip) const {
    return std::visit([&](const auto& law) { return law.coefficient(velocity, slip); }, law_);
  }
  [[nodiscard]] double slope(double velocity, double slip) const {
    return std::visit([&](const auto& law) { return law.slope(velocity, slip); }, law_);
  }

 private:
  Law law_;
};

}  // namespace rubatlas::contact

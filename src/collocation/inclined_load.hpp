/// How an elastic blade under an inclined load stands in an interval, as numbers: one blade of
/// `contact/directed_elastica.hpp`, without types.
///
/// With the chart (κ, φ) of `blade/inclined_elastica.hpp` as polar coordinates, and all of the blade
/// mirrored such that it bends to the positive side,
///     u = |κ| sin φ,   l = |κ| cos φ = ± sin(b/2),
/// b the angle of the load against the blade's axis. u is what the blade bends by, as in the paper's law; the
/// lean l of the load changes little during a contact and passes smoothly through zero where the load turns
/// to the blade's other side. The arc is one in (τ, p), where
///     u = σ (p + p³/3! + p⁵/5! + p⁷/7! + p⁹/9!),
/// close to σ sinh p, with σ = 2 |l| where the contact begins; l is a further unknown at each node.
#pragma once

#include <algorithm>
#include <cmath>

#include "contact/friction_law.hpp"
#include "contact/sticking_elastica.hpp"

namespace rubatlas::collocation {

struct InclinedLoad {
  bool along_normal;  ///< else along the undeformed blade (`contact::LoadDirection`)
  contact::Friction friction;
  bool rests = false;  ///< a tip that sticks: v = 0 takes the place of c = c(v)
  double side = 1.0;   ///< ±1: to which the blade is bent, the sign of κ
  double scale = 1.0;  ///< σ [-]

  static constexpr double kLeastScale = 1e-3;  ///< of σ

  /// Of π − φ where φ is largest (`blade::kLargestAmplitude`).
  static const double kEndCosine, kEndSine;
  /// |κ| sin(φ' − φ), φ' the largest φ: positive within the chart. Of a tip at rest times what is left of κ²
  /// until its blade is a strut.
  template <class Number>
  [[nodiscard]] Number chart_left(const Number& u, const Number& lean) const {
    const Number left = u * kEndCosine + lean * kEndSine;
    if (!rests) return left;
    // A little less, so that who judges the end of rest finds it there.
    constexpr double kLess = 1.0 - 1e-6;
    const double least = kLess * contact::kLeastModulus * friction.static_friction;
    return left * ((u * u + lean * lean) - least * least);
  }

  /// c² up to which friction holds a tip.
  [[nodiscard]] double cone() const {
    const double largest = (1.0 + contact::kBeyondCone) * friction.static_friction;
    return largest * largest;
  }

  /// u of p.
  [[nodiscard]] double bending(double p) const {
    const double square = p * p;
    return scale * p *
           (1.0 +
            square * (1.0 / 6 + square * (1.0 / 120 + square * (1.0 / 5040 + square * (1.0 / 362880)))));
  }
  /// du/dp, of which p² is known.
  template <class Number>
  [[nodiscard]] Number bending_slope(const Number& square) const {
    return ((((square * (1.0 / 40320) + 1.0 / 720) * square + 1.0 / 24) * square + 0.5) * square + 1.0) *
           scale;
  }
  /// D/L over p² where the blade is hardly bent.
  [[nodiscard]] double deflection_per_square(double lean) const {
    return 2.0 / 3.0 * scale * scale / std::max(std::abs(lean), 0.5 * kLeastScale);
  }
  /// p of u.
  [[nodiscard]] double argument(double u) const;
};

}  // namespace rubatlas::collocation

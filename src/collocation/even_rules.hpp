/// Gauss's rules for integrals from 0 to T of even functions that are analytic around [−T, T]: the half of a
/// rule on [−1, 1].
#pragma once

#include <array>
#include <cstddef>

namespace rubatlas::collocation {

struct EvenRule {
  static constexpr std::size_t kMost = 32;
  std::size_t count = 0;
  std::array<double, kMost> square{};  ///< of the places in [0, 1]
  std::array<double, kMost> weight{};  ///< whose sum is 1
  /// Least distance of singularities up to which it is accurate: the larger semi-axis and the smaller one,
  /// added, of the ellipse around [−1, 1] that goes through them.
  double least_ellipse = 0.0;
};

/// How to integrate over a bent blade (`inclined_tip.hpp`): over z, with
///     tan(φ'/4) = 2 q z / (1 − z²),   q = tanh(arcosh(1/|κ|)/4).
/// The integrands' nearest singularities, roots at φ' = ±i arcosh(1/|κ|), are none over z.
struct BladeRule {
  const EvenRule* rule = nullptr;  ///< null: beyond the largest rule
  double quarter = 0.0;            ///< q
};

/// The smallest rule that leaves less than about 1e-17 of the integrals up to a modulus |κ| and a tangent of
/// φ/4. What is left is a jump where an interval has another rule than the one before, and the place of a tip
/// at rest hardly tells κ and φ apart.
BladeRule blade_rule(double modulus, double tangent);

}  // namespace rubatlas::collocation

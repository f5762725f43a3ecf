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
};

/// The smallest rule that leaves less than about 1e-14 of the integrals over a bent blade
/// (`inclined_blade.hpp`) up to a modulus |κ| and a tangent of φ/4. Null beyond the largest rule.
const EvenRule* even_rule(double modulus, double tangent);

}  // namespace rubatlas::collocation

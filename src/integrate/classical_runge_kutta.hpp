/// The classical Runge–Kutta method of order 4, without error estimate.
///
/// Coefficients: E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed.,
/// Springer 1993, table II.1.2. Row 4 evaluates the end of a step, which is the first stage of the next one;
/// dense output is the cubic through both ends and their slopes.
#pragma once

#include <array>

namespace rubatlas::integrate {

struct ClassicalRungeKutta {
  static constexpr int kOrder = 4;
  static constexpr int kStages = 4;

  /// a[i][j]: weights of the stages j before stage i.
  static constexpr std::array<std::array<double, 4>, 5> kStage = {{
      {{0, 0, 0, 0}},
      {{1.0 / 2, 0, 0, 0}},
      {{0, 1.0 / 2, 0, 0}},
      {{0, 0, 1, 0}},
      {{1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6}},
  }};
  /// b[j]: weights of the solution.
  static constexpr std::array<double, 4> kWeight = kStage[4];

  /// No coefficients above those of the cubic.
  static constexpr std::array<std::array<double, 5>, 0> kDense = {};
};

}  // namespace rubatlas::integrate

/// Bogacki and Shampine's explicit Runge–Kutta pair of order 3(2).
///
/// Coefficients: P. Bogacki, L. F. Shampine, A 3(2) pair of Runge–Kutta formulas, Applied Mathematics Letters
/// 2 (1989) 321–325. Row 3 evaluates the end of a step and is the first stage of the next one; dense output
/// is the cubic through both ends and their slopes (Hermite), of order 3.
#pragma once

#include <array>
#include <span>

namespace rubatlas::integrate {

struct BogackiShampine32 {
  static constexpr int kOrder = 3;
  static constexpr int kStages = 3;

  /// a[i][j]: weights of the stages j before stage i.
  static constexpr std::array<std::array<double, 3>, 4> kStage = {{
      {{0, 0, 0}},
      {{1.0 / 2, 0, 0}},
      {{0, 3.0 / 4, 0}},
      {{2.0 / 9, 1.0 / 3, 4.0 / 9}},
  }};
  /// b[j]: weights of the solution.
  static constexpr std::array<double, 3> kWeight = kStage[3];
  /// Difference to the embedded solution of order 2.
  static constexpr std::array<std::array<double, 4>, 1> kErrors = {
      {{{-5.0 / 72, 1.0 / 12, 1.0 / 9, -1.0 / 8}}}};

  /// It falls with size^3.
  static double estimate(std::span<const double> norms) { return norms[0]; }
  static constexpr int kEstimatePower = 3;  ///< of the step, with which it falls
  /// The estimate is of the embedded solution, and taken as it is.
  static constexpr double kEstimateExcess = 1.0;

  /// No coefficients above those of the cubic.
  static constexpr std::array<std::array<double, 4>, 0> kDense = {};
};

}  // namespace rubatlas::integrate

/// Fehlberg's explicit Runge–Kutta pair 4(5): the solution of order 4 goes on, the one of order 5 tells its
/// error.
///
/// Coefficients: E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed.,
/// Springer 1993, table II.5.1 (E. Fehlberg, NASA TR R-315, 1969). Row 6 evaluates the end of a step, which
/// is the first stage of the next one; dense output is the cubic through both ends and their slopes.
#pragma once

#include <array>
#include <span>

namespace rubatlas::integrate {

struct Fehlberg45 {
  static constexpr int kOrder = 4;
  static constexpr int kStages = 6;

  /// a[i][j]: weights of the stages j before stage i.
  static constexpr std::array<std::array<double, 6>, 7> kStage = {{
      {{0, 0, 0, 0, 0, 0}},
      {{1.0 / 4, 0, 0, 0, 0, 0}},
      {{3.0 / 32, 9.0 / 32, 0, 0, 0, 0}},
      {{1932.0 / 2197, -7200.0 / 2197, 7296.0 / 2197, 0, 0, 0}},
      {{439.0 / 216, -8, 3680.0 / 513, -845.0 / 4104, 0, 0}},
      {{-8.0 / 27, 2, -3544.0 / 2565, 1859.0 / 4104, -11.0 / 40, 0}},
      {{25.0 / 216, 0, 1408.0 / 2565, 2197.0 / 4104, -1.0 / 5, 0}},
  }};
  /// b[j]: weights of the solution.
  static constexpr std::array<double, 6> kWeight = kStage[6];
  /// Difference to the embedded solution of order 5.
  static constexpr std::array<std::array<double, 6>, 1> kErrors = {
      {{{25.0 / 216 - 16.0 / 135, 0, 1408.0 / 2565 - 6656.0 / 12825, 2197.0 / 4104 - 28561.0 / 56430,
         -1.0 / 5 + 9.0 / 50, -2.0 / 55}}}};

  /// The local error of the solution itself, which falls with size^5.
  static double estimate(std::span<const double> norms) { return norms[0]; }
  static constexpr int kEstimatePower = 5;  ///< of the step, with which it falls
  static constexpr double kEstimateExcess = 1.0;

  /// No coefficients above those of the cubic.
  static constexpr std::array<std::array<double, 7>, 0> kDense = {};
};

}  // namespace rubatlas::integrate

/// Dormand and Prince's explicit Runge–Kutta pair of order 5(4) with dense output of order 4.
///
/// Coefficients: E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed.,
/// Springer 1993, table II.5.2; dense output (II.6) as in the code DOPRI5 of its appendix. Row 6 evaluates
/// the end of a step and is the first stage of the next one; dense output needs no further stage.
#pragma once

#include <array>
#include <span>

namespace rubatlas::integrate {

struct DormandPrince54 {
  static constexpr int kOrder = 5;
  static constexpr int kStages = 6;

  /// a[i][j]: weights of the stages j before stage i.
  static constexpr std::array<std::array<double, 6>, 7> kStage = {{
      {{0, 0, 0, 0, 0, 0}},
      {{1.0 / 5, 0, 0, 0, 0, 0}},
      {{3.0 / 40, 9.0 / 40, 0, 0, 0, 0}},
      {{44.0 / 45, -56.0 / 15, 32.0 / 9, 0, 0, 0}},
      {{19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729, 0, 0}},
      {{9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656, 0}},
      {{35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}},
  }};
  /// b[j]: weights of the solution.
  static constexpr std::array<double, 6> kWeight = kStage[6];
  /// Difference to the embedded solution of order 4.
  static constexpr std::array<std::array<double, 7>, 1> kErrors = {
      {{{71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40}}}};

  /// It falls with size^5.
  static double estimate(std::span<const double> norms) { return norms[0]; }
  static constexpr int kEstimatePower = 5;  ///< of the step, with which it falls
  /// The estimate is of the embedded solution, and taken as it is.
  static constexpr double kEstimateExcess = 1.0;

  /// d[i][j]: stage weights of the upper coefficient of dense output.
  static constexpr std::array<std::array<double, 7>, 1> kDense = {
      {{{-12715105075.0 / 11282082432, 0, 87487479700.0 / 32700410799, -10690763975.0 / 1880347072,
         701980252875.0 / 199316789632, -1453857185.0 / 822651844, 69997945.0 / 29380423}}}};
};

}  // namespace rubatlas::integrate

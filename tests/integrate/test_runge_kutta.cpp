/// Steps of the pair on problems whose motion is known: order, dense output, rejection, no memory asked for.
///
/// Kepler's problem: x'' = −x/|x|³ from the pericentre of an ellipse of eccentricity e and semi-axis 1; the
/// position at the eccentric anomaly E is (cos E − e, sqrt(1 − e²) sin E), the time E − e sin E.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "allocations.hpp"
#include "convergence_order.hpp"
#include "integrate/dormand_prince_853.hpp"
#include "integrate/runge_kutta.hpp"
#include "integrate/step_control.hpp"
#include "integrate/step_factor.hpp"

namespace rubatlas::integrate {
namespace {

using EighthOrder = RungeKutta<DormandPrince853, 4>;
using PlanarState = EighthOrder::Vector;

constexpr double kEccentricity = 0.1;

struct Kepler {
  int evaluations = 0;
  bool operator()(const PlanarState& state, PlanarState& derivative) {
    ++evaluations;
    const double square = state[0] * state[0] + state[1] * state[1];
    const double cube = square * std::sqrt(square);
    derivative << state[2], state[3], -state[0] / cube, -state[1] / cube;
    return true;
  }
};

PlanarState on_the_ellipse(double time) {
  long double anomaly = time;
  for (int i = 0; i < 50; ++i) {
    anomaly -= (anomaly - kEccentricity * std::sin(anomaly) - time) / (1 - kEccentricity * std::cos(anomaly));
  }
  const long double minor = std::sqrt(1 - static_cast<long double>(kEccentricity) * kEccentricity);
  const long double rate = 1 / (1 - kEccentricity * std::cos(anomaly));
  PlanarState state;
  state << static_cast<double>(std::cos(anomaly) - kEccentricity),
      static_cast<double>(minor * std::sin(anomaly)), static_cast<double>(-std::sin(anomaly) * rate),
      static_cast<double>(minor * std::cos(anomaly) * rate);
  return state;
}

TEST(RungeKutta, GlobalErrorFallsWithTheEighthPowerOfTheStep) {
  std::vector<std::pair<double, double>> errors;
  const double duration = 6.0;
  for (const int steps : {32, 40, 48, 56, 64, 72}) {
    Kepler kepler;
    EighthOrder method;
    method.begin(kepler, on_the_ellipse(0.0));
    for (int i = 0; i < steps; ++i) {
      ASSERT_TRUE(method.attempt(kepler, duration / steps));
      method.accept();
    }
    errors.emplace_back(duration / steps, largest_difference(method.start(), on_the_ellipse(duration)));
  }
  ASSERT_GT(errors.back().second, 1e-13) << "above rounding";
  EXPECT_NEAR(convergence_order(errors), 8.0, 0.3);
}

/// Errors of one step from exact values over the orbit, for a list of sizes.
template <class Error>
std::vector<std::pair<double, double>> local_errors(Error error) {
  std::vector<std::pair<double, double>> errors;
  for (const double size : {0.5, 0.42, 0.35, 0.3, 0.25}) {
    double largest = 0.0;
    for (double time = 0.0; time < 6.0; time += 0.37) {
      Kepler kepler;
      EighthOrder method;
      method.begin(kepler, on_the_ellipse(time));
      EXPECT_TRUE(method.attempt(kepler, size));
      largest = std::max(largest, error(method, kepler, time, size));
    }
    errors.emplace_back(size, largest);
  }
  return errors;
}

TEST(RungeKutta, DenseOutputIsOfOrderSeven) {
  const auto errors = local_errors([](EighthOrder& method, Kepler& kepler, double time, double size) {
    EXPECT_TRUE(method.make_dense(kepler));
    double largest = 0.0;
    for (double part = 0.0625; part < 1.0; part += 0.0625) {
      largest =
          std::max(largest, largest_difference(method.interpolate(part), on_the_ellipse(time + part * size)));
    }
    return largest;
  });
  ASSERT_GT(errors.back().second, 1e-13);
  EXPECT_NEAR(convergence_order(errors) - 1, 7.0, 0.4);
}

double largest_component(const PlanarState& difference) {
  return difference.abs().maxCoeff();
}

TEST(RungeKutta, ErrorEstimateIsOfOrderEight) {
  // DOP853 combines the differences to solutions of order 3 and 5 (h⁴ and h⁶) to h¹²/h⁴.
  const auto errors = local_errors(
      [](EighthOrder& method, Kepler&, double, double) { return method.error_estimate(largest_component); });
  EXPECT_NEAR(convergence_order(errors), 8.0, 0.5);
}

TEST(RungeKutta, ErrorEstimateBoundsTheErrorOfAStep) {
  // An estimate, not a proof: on this mild orbit it bounds the error, at an eccentricity of 0.3 the error
  // reaches three times as much where steps are coarse.
  for (const double size : {0.1, 0.2, 0.3, 0.4}) {
    for (double time = 0.0; time < 6.0; time += 0.37) {
      Kepler kepler;
      EighthOrder method;
      method.begin(kepler, on_the_ellipse(time));
      ASSERT_TRUE(method.attempt(kepler, size));
      const double bound = method.error_estimate(largest_component);
      EXPECT_LE(largest_difference(method.end(), on_the_ellipse(time + size)), bound + 2e-15)
          << size << ", " << time;
    }
  }
}

TEST(RungeKutta, DenseOutputJoinsTheEndsOfTheStep) {
  Kepler kepler;
  EighthOrder method;
  method.begin(kepler, on_the_ellipse(0.4));
  ASSERT_TRUE(method.attempt(kepler, 0.3));
  ASSERT_TRUE(method.make_dense(kepler));
  EXPECT_EQ(largest_difference(method.interpolate(0.0), method.start()), 0.0);
  EXPECT_LE(largest_difference(method.interpolate(1.0), method.end()), 2e-16);
  const double step = 1e-5;
  const PlanarState start_slope = (method.interpolate(step) - method.start()) / (step * 0.3);
  const PlanarState end_slope = (method.end() - method.interpolate(1 - step)) / (step * 0.3);
  EXPECT_LE(largest_difference(start_slope, method.start_derivative()), 1e-4);
  EXPECT_LE(largest_difference(end_slope, method.end_derivative()), 1e-4);
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(method.slope(0.0, k), 0.3 * method.start_derivative()[k], 1e-15);
}

TEST(RungeKutta, StepIsTheSameToTheLastBitEachTime) {
  const auto run = [] {
    Kepler kepler;
    EighthOrder method;
    method.begin(kepler, on_the_ellipse(0.0));
    for (int i = 0; i < 50; ++i) {
      method.attempt(kepler, 0.1 + 0.002 * i);
      method.accept();
    }
    method.attempt(kepler, 0.2);
    method.make_dense(kepler);
    return method.interpolate(0.3);
  };
  const PlanarState first = run();
  const PlanarState second = run();
  for (int k = 0; k < 4; ++k) EXPECT_EQ(first[k], second[k]);
}

TEST(RungeKutta, RepeatedAttemptDoesNotRememberTheFailedOne) {
  Kepler kepler;
  EighthOrder fresh;
  fresh.begin(kepler, on_the_ellipse(0.0));
  fresh.attempt(kepler, 0.2);
  EighthOrder repeated;
  repeated.begin(kepler, on_the_ellipse(0.0));
  repeated.attempt(kepler, 0.9);
  repeated.make_dense(kepler);
  repeated.attempt(kepler, 0.2);
  EXPECT_EQ(largest_difference(fresh.end(), repeated.end()), 0.0);
  ASSERT_TRUE(fresh.make_dense(kepler) && repeated.make_dense(kepler));
  EXPECT_EQ(largest_difference(fresh.interpolate(0.6), repeated.interpolate(0.6)), 0.0);
}

TEST(RungeKutta, StepCostsTwelveEvaluationsAndDenseOutputThreeOnce) {
  Kepler kepler;
  EighthOrder method;
  method.begin(kepler, on_the_ellipse(0.0));
  EXPECT_EQ(std::exchange(kepler.evaluations, 0), 1);
  method.attempt(kepler, 0.1);
  EXPECT_EQ(std::exchange(kepler.evaluations, 0), 12);
  method.make_dense(kepler);
  method.make_dense(kepler);
  EXPECT_EQ(std::exchange(kepler.evaluations, 0), 3);
  method.accept();
  EXPECT_EQ(kepler.evaluations, 0);
}

TEST(RungeKutta, StepAsksForNoMemory) {
  Kepler kepler;
  EighthOrder method;
  const PlanarState start = on_the_ellipse(0.0);
  const std::size_t before = allocations();
  method.begin(kepler, start);
  double sum = 0.0;
  for (int i = 0; i < 100; ++i) {
    method.attempt(kepler, 0.1);
    sum += method.error_estimate(largest_component);
    method.make_dense(kepler);
    sum += method.interpolate(0.5).sum();
    method.accept();
  }
  const std::size_t after = allocations();
  EXPECT_EQ(after, before);
  EXPECT_TRUE(std::isfinite(sum));
  // The count is alive.
  const std::vector<double> memory(1000, sum);
  EXPECT_GT(allocations(), after) << memory.size();
}

/// Says no from the given evaluation on.
struct Refusing {
  int allowed;
  bool operator()(const PlanarState& state, PlanarState& derivative) {
    derivative = -state;
    return allowed-- > 0;
  }
};

TEST(RungeKutta, StepIsRejectedWhereTheSystemCannotBeEvaluated) {
  const PlanarState start = PlanarState::Ones();
  EighthOrder method;
  Refusing at_once{0};
  EXPECT_FALSE(method.begin(at_once, start));
  for (int good = 0; good < 12; ++good) {
    Refusing system{good + 1};
    ASSERT_TRUE(method.begin(system, start));
    EXPECT_FALSE(method.attempt(system, 0.1)) << "refused at stage " << good + 1;
  }
  Refusing enough{13};
  ASSERT_TRUE(method.begin(enough, start));
  EXPECT_TRUE(method.attempt(enough, 0.1));
  EXPECT_FALSE(method.make_dense(enough));
}

TEST(RungeKutta, StepIsRejectedWhereTheStateIsNotFinite) {
  const auto explodes = [](const PlanarState& state, PlanarState& derivative) {
    derivative = state * std::numeric_limits<double>::max();
    return true;
  };
  EighthOrder method;
  ASSERT_TRUE(method.begin(explodes, PlanarState::Ones()));
  EXPECT_FALSE(method.attempt(explodes, 1.0));
}

TEST(RungeKutta, ShiftMovesOneComponentOfTheWholeStep) {
  Kepler kepler;
  EighthOrder method;
  method.begin(kepler, on_the_ellipse(0.0));
  method.attempt(kepler, 0.2);
  method.make_dense(kepler);
  const PlanarState before = method.interpolate(0.5);
  method.shift(1, -2.0);
  EXPECT_EQ(method.start()[1], -2.0);
  EXPECT_NEAR(method.interpolate(0.5)[1], before[1] - 2.0, 2e-16);
  EXPECT_EQ(method.interpolate(0.5)[0], before[0]);
}

TEST(DormandPrince853, CombinesItsTwoEstimatesAsDop853Does) {
  // The norm of the fifth-order difference, damped by how much smaller it is than that of the third.
  const auto combined = [](double third, double fifth) {
    return DormandPrince853::estimate(std::array{third, fifth});
  };
  EXPECT_EQ(combined(0.0, 0.0), 0.0);
  EXPECT_NEAR(combined(0.0, 3.0), 3.0, 1e-15);
  EXPECT_NEAR(combined(40.0, 3.0), 9.0 / 5.0, 1e-15);
}

TEST(DormandPrince853, AStepWhoseErrorsAreTooLargeToBeSquaredIsRejected) {
  constexpr double kHuge = 1e200;
  constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
  for (const double third : {1.0, kHuge, kNoNumber}) {
    for (const double fifth : {1.0, kHuge, kNoNumber}) {
      if (third == 1.0 && fifth == 1.0) continue;
      const double estimate = DormandPrince853::estimate(std::array{third, fifth});
      EXPECT_FALSE(StepControl::acceptable(estimate)) << third << ", " << fifth;
    }
  }
}

TEST(StepFactor, NextStepAimsAtTheToleranceWithinBounds) {
  EXPECT_EQ(step_factor(0.0, 5), 5.0);
  EXPECT_EQ(step_factor(1e-30, 5), 5.0);
  EXPECT_EQ(step_factor(1e30, 5), 0.2);
  EXPECT_EQ(step_factor(std::numeric_limits<double>::infinity(), 5), 0.2);
  EXPECT_NEAR(step_factor(1.0, 5), 0.9, 1e-15);
  EXPECT_NEAR(step_factor(std::pow(0.6, 5), 5), 1.5, 1e-14);
}

TEST(StepControl, RelativeSizeTendsToWhereTheErrorStandsBelowWhatIsAccepted) {
  // An error that falls exactly with size^8 and is 1 at a size of 0.3.
  const auto error = [](double size) { return std::pow(size / 0.3, 8); };
  for (const double first : {0.01, 0.1, 0.29}) {
    StepControl control(8, first);
    for (int i = 0; i < 60; ++i) control.accept(error(control.relative_size()));
    EXPECT_LT(error(control.relative_size()), 1.0) << "accepted with a margin";
    EXPECT_GT(error(control.relative_size()), 0.01) << "not wasted";
  }
}

TEST(StepControl, RejectedStepIsFollowedByAShorterOne) {
  for (const double error : {1.001, 3.0, 1e8, std::numeric_limits<double>::infinity()}) {
    StepControl control(8, 0.2);
    EXPECT_FALSE(StepControl::acceptable(error));
    control.reject(error);
    EXPECT_LT(control.relative_size(), 0.2) << error;
    EXPECT_GT(control.relative_size(), 0.0) << error;
  }
}

TEST(StepControl, RoundedSizeIsTheNearestPowerOfFour) {
  for (const auto& [size, nearest] : {std::pair{0.3, 0.25}, {0.12, 0.0625}, {0.13, 0.25}, {1e-3, 0x1p-10}}) {
    StepControl control(8, size);
    control.round_size();
    EXPECT_EQ(control.relative_size(), nearest) << size;
  }
}

}  // namespace
}  // namespace rubatlas::integrate

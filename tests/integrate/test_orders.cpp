/// Every table of Runge–Kutta coefficients does what its order says, through one list.
///
/// Orders are measured on a problem with all elementary differentials at work (Kepler's, with the time as a
/// fifth component that a forcing reads), the coefficients themselves on quadrature.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "convergence_order.hpp"
#include "integrate/bogacki_shampine_32.hpp"
#include "integrate/classical_runge_kutta.hpp"
#include "integrate/dormand_prince_54.hpp"
#include "integrate/dormand_prince_853.hpp"
#include "integrate/fehlberg_45.hpp"
#include "integrate/runge_kutta.hpp"

namespace rubatlas::integrate {
namespace {

using Vector = Eigen::Array<double, 5, 1>;

/// A circular Kepler orbit whose forcing, of the time, makes the ellipse of `exact` the solution:
/// x = 1.2 cos τ, y = 0.8 sin τ under gravity and the rest as forcing.
struct ForcedOrbit {
  int evaluations = 0;
  bool operator()(const Vector& state, Vector& derivative) {
    ++evaluations;
    const double time = state[4];
    const double x = 1.2 * std::cos(time);
    const double y = 0.8 * std::sin(time);
    const auto gravity = [](double px, double py) { return std::pow(px * px + py * py, -1.5); };
    const double here = gravity(state[0], state[1]);
    const double there = gravity(x, y);
    derivative << state[2], state[3], -state[0] * here - x + x * there, -state[1] * here - y + y * there, 1.0;
    return true;
  }
};

Vector exact(double time) {
  Vector state;
  state << 1.2 * std::cos(time), 0.8 * std::sin(time), -1.2 * std::sin(time), 0.8 * std::cos(time), time;
  return state;
}

/// The largest of an error of one step over the orbit, for a list of sizes.
template <class Method, class Error>
std::vector<std::pair<double, double>> local_errors(double largest_size, Error error) {
  std::vector<std::pair<double, double>> errors;
  for (const double share : {1.0, 0.84, 0.7, 0.6, 0.5}) {
    const double size = largest_size * share;
    double largest = 0.0;
    for (double time = 0.0; time < 6.0; time += 0.17) {
      ForcedOrbit orbit;
      Method method;
      method.begin(orbit, exact(time));
      EXPECT_TRUE(method.attempt(orbit, size));
      largest = std::max(largest, error(method, orbit, time, size));
    }
    errors.emplace_back(size, largest);
  }
  return errors;
}

/// What is known of each table.
template <class T>
struct Known;
template <>
struct Known<ClassicalRungeKutta> {
  static constexpr int kDenseOrder = 3;
  static constexpr double kSize = 0.05;  ///< coarsest step, in the range where the order shows
};
template <>
struct Known<BogackiShampine32> {
  static constexpr int kDenseOrder = 3;
  static constexpr double kSize = 0.03;
  static constexpr int kEstimatePower = BogackiShampine32::kEstimatePower;
};
template <>
struct Known<Fehlberg45> {
  static constexpr int kDenseOrder = 3;
  static constexpr double kSize = 0.06;
  static constexpr int kEstimatePower = Fehlberg45::kEstimatePower;
};
template <>
struct Known<DormandPrince54> {
  static constexpr int kDenseOrder = 4;
  static constexpr double kSize = 0.02;  ///< its leading error is small, so that the next one shows for long
  static constexpr int kEstimatePower = DormandPrince54::kEstimatePower;
};
template <>
struct Known<DormandPrince853> {
  static constexpr int kDenseOrder = 7;
  static constexpr double kSize = 0.25;
  static constexpr int kEstimatePower = 8;  ///< of both estimates combined
};

template <class Table>
class EveryTable : public ::testing::Test {};
using AllTables =
    ::testing::Types<ClassicalRungeKutta, BogackiShampine32, Fehlberg45, DormandPrince54, DormandPrince853>;
TYPED_TEST_SUITE(EveryTable, AllTables);

template <class Table>
class EveryPair : public ::testing::Test {};
using AllPairs = ::testing::Types<BogackiShampine32, Fehlberg45, DormandPrince54, DormandPrince853>;
TYPED_TEST_SUITE(EveryPair, AllPairs);

TYPED_TEST(EveryTable, GlobalErrorFallsWithItsOrder) {
  using Method = RungeKutta<TypeParam, 5>;
  const double duration = 3.0;
  std::vector<std::pair<double, double>> errors;
  for (const double share : {1.0, 0.84, 0.7, 0.6, 0.5}) {
    const int steps = static_cast<int>(std::lround(duration / (Known<TypeParam>::kSize * share)));
    ForcedOrbit orbit;
    Method method;
    method.begin(orbit, exact(0.0));
    double largest = 0.0;  // over the run: at one time the leading terms may cancel
    for (int i = 0; i < steps; ++i) {
      ASSERT_TRUE(method.attempt(orbit, duration / steps));
      method.accept();
      largest = std::max(largest, largest_difference(method.start(), exact(duration * (i + 1) / steps)));
    }
    errors.emplace_back(duration / steps, largest);
  }
  ASSERT_GT(errors.back().second, 1e-14) << "above rounding";
  EXPECT_NEAR(convergence_order(errors), TypeParam::kOrder, 0.35);
}

TYPED_TEST(EveryTable, LocalErrorFallsWithOneOrderMore) {
  const auto errors = local_errors<RungeKutta<TypeParam, 5>>(
      Known<TypeParam>::kSize, [](auto& method, ForcedOrbit&, double time, double size) {
        return largest_difference(method.end(), exact(time + size));
      });
  EXPECT_NEAR(convergence_order(errors), TypeParam::kOrder + 1, 0.35);
}

TYPED_TEST(EveryTable, DenseOutputIsOfItsOrder) {
  const auto errors = local_errors<RungeKutta<TypeParam, 5>>(
      Known<TypeParam>::kSize, [](auto& method, ForcedOrbit& orbit, double time, double size) {
        EXPECT_TRUE(method.make_dense(orbit));
        double largest = 0.0;
        for (double part = 0.0625; part < 1.0; part += 0.0625) {
          largest =
              std::max(largest, largest_difference(method.interpolate(part), exact(time + part * size)));
        }
        return largest;
      });
  EXPECT_NEAR(convergence_order(errors), Known<TypeParam>::kDenseOrder + 1, 0.4);
}

TYPED_TEST(EveryTable, DenseOutputMeetsTheEndsOfTheStep) {
  ForcedOrbit orbit;
  RungeKutta<TypeParam, 5> method;
  method.begin(orbit, exact(0.4));
  ASSERT_TRUE(method.attempt(orbit, 0.3));
  ASSERT_TRUE(method.make_dense(orbit));
  EXPECT_EQ(largest_difference(method.interpolate(0.0), method.start()), 0.0);
  EXPECT_LE(largest_difference(method.interpolate(1.0), method.end()), 4e-16);
}

TYPED_TEST(EveryTable, StepCostsItsStages) {
  ForcedOrbit orbit;
  RungeKutta<TypeParam, 5> method;
  method.begin(orbit, exact(0.0));
  EXPECT_EQ(std::exchange(orbit.evaluations, 0), 1);
  method.attempt(orbit, 0.1);
  EXPECT_EQ(std::exchange(orbit.evaluations, 0), TypeParam::kStages) << "the end's included";
  method.make_dense(orbit);
  EXPECT_EQ(std::exchange(orbit.evaluations, 0),
            static_cast<int>(TypeParam::kStage.size()) - TypeParam::kStages - 1);
  method.accept();
  EXPECT_EQ(orbit.evaluations, 0);
}

/// Σ weight_i c_i^power of a row of weights, with nodes as the sums of the rows.
template <class Table, class Weights>
double moment(const Weights& weights, int power) {
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    double node = 0.0;
    for (const double weight : Table::kStage[i]) node += weight;
    sum += weights[i] * (power == 0 ? 1.0 : std::pow(node, power));
  }
  return sum;
}

TYPED_TEST(EveryTable, WeightsIntegratePolynomialsToItsOrder) {
  for (int power = 0; power < TypeParam::kOrder; ++power) {
    EXPECT_NEAR(moment<TypeParam>(TypeParam::kWeight, power), 1.0 / (power + 1), 2e-14) << power;
  }
}

TYPED_TEST(EveryTable, RowOfTheEndRepeatsTheWeights) {
  constexpr auto kLast = static_cast<std::size_t>(TypeParam::kStages);
  for (std::size_t j = 0; j < TypeParam::kWeight.size(); ++j) {
    EXPECT_EQ(TypeParam::kStage[kLast][j], TypeParam::kWeight[j]) << j;
  }
}

TYPED_TEST(EveryPair, EstimateFallsWithThePowerThatItStates) {
  const auto errors = local_errors<RungeKutta<TypeParam, 5>>(
      Known<TypeParam>::kSize, [](auto& method, ForcedOrbit&, double, double) {
        return method.error_estimate([](const Vector& difference) { return difference.abs().maxCoeff(); });
      });
  EXPECT_NEAR(convergence_order(errors), Known<TypeParam>::kEstimatePower, 0.35);
}

TYPED_TEST(EveryPair, EstimateIsNotFarBelowTheErrorOfAStep) {
  // An estimate, not a proof. Where the solution of higher order goes on it lies far above the error; where
  // the one of lower order goes on (Fehlberg) it is the error itself but for terms of the next order.
  using Method = RungeKutta<TypeParam, 5>;
  for (double time = 0.0; time < 6.0; time += 0.17) {
    ForcedOrbit orbit;
    Method method;
    method.begin(orbit, exact(time));
    ASSERT_TRUE(method.attempt(orbit, 0.5 * Known<TypeParam>::kSize));
    const double estimate =
        method.error_estimate([](const Vector& difference) { return difference.abs().maxCoeff(); });
    EXPECT_LE(largest_difference(method.end(), exact(time + method.size())), 1.2 * estimate + 1e-15) << time;
  }
}

}  // namespace
}  // namespace rubatlas::integrate

/// The numbers of the method: exact where the method is.
#include "collocation/nodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "collocation/interval.hpp"

namespace rubatlas::test {
namespace {

using namespace collocation;

/// Σ A_ij θ_j^k at node i, against θ_i^(k+1)/(k+1).
double integral_of_power(std::size_t node, int power) {
  const NodeTables& tables = kNodeTables;
  double sum = 0.0;
  for (std::size_t j = 0; j < kNodes; ++j) sum += tables.integral[j][node] * std::pow(tables.node[j], power);
  return sum;
}

TEST(RadauNodes, IntegratePolynomialsOfDegreeSevenExactlyUpToEachNode) {
  for (std::size_t i = 0; i < kNodes; ++i) {
    for (int power = 0; power <= 7; ++power) {
      const double exact = std::pow(kNodeTables.node[i], power + 1) / (power + 1);
      EXPECT_NEAR(integral_of_power(i, power), exact, 1e-15) << "node " << i << ", power " << power;
    }
  }
}

TEST(RadauNodes, IntegrateOverTheWholeIntervalUpToDegreeFourteenAndNoFurther) {
  for (int power = 0; power <= 14; ++power)
    EXPECT_NEAR(integral_of_power(kNodes - 1, power), 1.0 / (power + 1), 1e-15) << "power " << power;
  EXPECT_GT(std::abs(integral_of_power(kNodes - 1, 15) - 1.0 / 16), 1e-10);
}

TEST(RadauNodes, SlopesAreThoseOfThePolynomialThroughTheStartAndTheNodes) {
  const NodeTables& tables = kNodeTables;
  for (int power = 1; power <= 8; ++power) {
    for (std::size_t i = 0; i < kNodes; ++i) {
      double slope = 0.0;
      for (std::size_t j = 0; j < kNodes; ++j) slope += tables.slope[j][i] * std::pow(tables.node[j], power);
      EXPECT_NEAR(slope, power * std::pow(tables.node[i], power - 1), 2e-13) << "power " << power;
    }
  }
}

TEST(RadauNodes, BasesReproduceThePolynomialsOfTheirDegree) {
  const NodeTables& tables = kNodeTables;
  for (const double at : {0.0, 1e-9, 0.1, tables.node[3], 0.5, 0.93, 1.0}) {
    const AtPlaces basis = basis_at(at);
    const AtNodes slopes = slope_basis_at(at);
    for (int power = 0; power <= 8; ++power) {
      double value = 0.0;
      for (std::size_t i = 0; i < kPlaces; ++i) value += basis[i] * std::pow(tables.place[i], power);
      EXPECT_NEAR(value, std::pow(at, power), 1e-14) << "power " << power << " at " << at;
    }
    for (int power = 0; power <= 7; ++power) {
      double slope = 0.0;
      for (std::size_t i = 0; i < kNodes; ++i) slope += slopes[i] * std::pow(tables.node[i], power);
      EXPECT_NEAR(slope, std::pow(at, power), 1e-13) << "power " << power << " at " << at;
    }
  }
}

TEST(RadauNodes, NoPolynomialGoesMuchFartherFromItsStartThanItsNodes) {
  double farthest = 0.0;
  for (double at = 0.0; at <= 1.0; at += 1e-4) {
    const AtPlaces basis = basis_at(at);
    double sum = 0.0;
    for (std::size_t i = 1; i < kPlaces; ++i) sum += std::abs(basis[i]);
    farthest = std::max(farthest, sum);
  }
  EXPECT_LT(farthest, kFarther);
  EXPECT_GT(farthest, 0.99 * kFarther);
}

AtPlaces values_of(double (*function)(double)) {
  AtPlaces values{};
  for (std::size_t i = 0; i < kPlaces; ++i) values[i] = function(kNodeTables.place[i]);
  return values;
}

/// `valid_shortening`: up to which nothing else than a bound of the shortening is asked for.
Bounds bounds_of(Interval& interval, double misalignment, double valid_shortening = 0.0) {
  Blade blade;
  blade.valid_shortening = valid_shortening;
  interval.leader().blade = &blade;
  const collocation::Machine machine{.speed_ratio = 0.0,
                                     .damping_ratio = 0.0,
                                     .misalignment = misalignment,
                                     .ring_radius = 1.0,
                                     .force_unit = 1.0};
  Bounds bounds{};
  interval_solver().bounds(machine, interval, bounds);
  interval.leader().blade = nullptr;
  return bounds;
}

Bounds bounds_of_gap_measure(double (*function)(double)) {
  Interval interval;
  const AtPlaces values = values_of(function);
  interval.leader().start_gap_measure = values[0];
  std::copy(values.begin() + 1, values.end(), interval.leader().gap_measure.value.begin());
  return bounds_of(interval, 0.0);
}

TEST(BoundsOfAnInterval, ArePositiveWhereThePolynomialIsAndNowhereElse) {
  EXPECT_GT(bounds_of_gap_measure([](double t) { return 1.0 - 0.99 * t; }).gap_measure, 0.0);
  EXPECT_GT(bounds_of_gap_measure([](double t) { return std::exp(-3.0 * t); }).gap_measure, 0.0);
  // Positive at all places, negative between two of them.
  EXPECT_LT(bounds_of_gap_measure([](double t) { return (t - 0.54) * (t - 0.56); }).gap_measure, 0.0);
  // Zero at the start, which is left out.
  EXPECT_GT(bounds_of_gap_measure([](double t) { return t * (2.0 - t); }).gap_measure, 0.0);
}

TEST(BoundsOfAnInterval, HoldEveryQuantityBetweenTheNodes) {
  Interval interval;
  TipInTime& tip = interval.leader();
  const auto fill = [](double& start, AtNodes& at, double (*function)(double)) {
    const AtPlaces values = values_of(function);
    start = values[0];
    std::copy(values.begin() + 1, values.end(), at.value.begin());
  };
  constexpr double kMisalignment = 0.3;
  const auto x = [](double t) { return std::sin(3.0 * t); };
  const auto y = [](double t) { return t * t - 0.7 * t; };
  const auto slip_velocity = [](double t) { return -2.0 + std::cos(4.0 * t); };
  const auto shortening = [](double t) { return 1.0 + t * (0.9 - t); };
  fill(interval.shaft.start[0], interval.shaft.x, x);
  fill(interval.shaft.start[1], interval.shaft.y, y);
  fill(tip.at_start.slip_velocity, tip.slip_velocity, slip_velocity);
  fill(tip.at_start.shortening, tip.shortening, shortening);
  const Bounds bounds = bounds_of(interval, kMisalignment);
  const Bounds loose = bounds_of(interval, kMisalignment, 10.0);
  const double displacement = interval_solver().largest_displacement(interval);
  constexpr double kRounding = 1e-5;  // of the polynomials through the values of these functions
  for (double t = 0.0; t <= 1.0; t += 0.001) {
    EXPECT_LE(std::hypot(x(t), y(t)), displacement + kRounding);
    EXPECT_LE(std::hypot(x(t) - x(0.0), y(t) - y(0.0)), bounds.moved + kRounding);
    EXPECT_LE(std::hypot(x(t), y(t) + kMisalignment), bounds.distance + kRounding);
    EXPECT_GE(-slip_velocity(t), bounds.tips[0].slip_velocity - kRounding);
    EXPECT_LE(shortening(t), bounds.tips[0].shortening + kRounding);
    EXPECT_LE(shortening(t), loose.tips[0].shortening + kRounding);
  }
  // No looser than by a third.
  EXPECT_LT(bounds.tips[0].shortening, 1.21 * 1.33);
  EXPECT_LT(bounds.tips[0].shortening, loose.tips[0].shortening);
  EXPECT_GT(bounds.tips[0].slip_velocity, 0.0);
}

}  // namespace
}  // namespace rubatlas::test

/// The numbers of the method: exact where the method is.
#include "collocation/nodes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rubatlas::test {
namespace {

using namespace collocation;

/// Σ A_ij θ_j^k at node i, against θ_i^(k+1)/(k+1).
double integral_of_power(std::size_t node, int power) {
  const NodeTables& tables = node_tables();
  double sum = 0.0;
  for (std::size_t j = 0; j < kNodes; ++j) sum += tables.integral[j][node] * std::pow(tables.node[j], power);
  return sum;
}

TEST(RadauNodes, IntegratePolynomialsOfDegreeSevenExactlyUpToEachNode) {
  for (std::size_t i = 0; i < kNodes; ++i) {
    for (int power = 0; power <= 7; ++power) {
      const double exact = std::pow(node_tables().node[i], power + 1) / (power + 1);
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
  const NodeTables& tables = node_tables();
  for (int power = 1; power <= 8; ++power) {
    for (std::size_t i = 0; i < kNodes; ++i) {
      double slope = 0.0;
      for (std::size_t j = 0; j < kNodes; ++j) slope += tables.slope[j][i] * std::pow(tables.node[j], power);
      EXPECT_NEAR(slope, power * std::pow(tables.node[i], power - 1), 2e-13) << "power " << power;
    }
  }
}

TEST(RadauNodes, InterpolationGoesBeyondTheValuesAtThePlacesByLessThanTheirDifference) {
  // Lebesgue's constant: the largest sum of magnitudes of the basis.
  double largest = 0.0;
  for (int i = 0; i <= 10000; ++i) {
    double sum = 0.0;
    for (const double value : basis_at(i / 10000.0)) sum += std::abs(value);
    largest = std::max(largest, sum);
  }
  EXPECT_LT(largest, 3.0);
  EXPECT_GT(largest, 2.6);
}

AtPlaces values_of(double (*function)(double)) {
  AtPlaces values{};
  for (std::size_t i = 0; i < kPlaces; ++i) values[i] = function(node_tables().place[i]);
  return values;
}

TEST(ProvenPositive, AcceptsWhatIsPositiveAndNothingThatIsNot) {
  EXPECT_TRUE(proven_positive(values_of([](double t) { return 1.0 - 0.99 * t; })));
  EXPECT_TRUE(proven_positive(values_of([](double t) { return std::exp(-3.0 * t); })));
  // Positive at all places, negative between two of them.
  EXPECT_FALSE(proven_positive(values_of([](double t) { return (t - 0.54) * (t - 0.56); })));
  EXPECT_FALSE(proven_positive(values_of([](double t) { return t; })));
  EXPECT_TRUE(proven_positive(values_of([](double t) { return t * (2.0 - t); }), true));
}

}  // namespace
}  // namespace rubatlas::test

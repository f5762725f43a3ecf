/// The first crossing of a guard in a step: none is jumped, and none is seen where there is none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "integrate/cubic_range.hpp"
#include "integrate/first_crossing.hpp"

namespace rubatlas::integrate {
namespace {

/// Π (x − root), times a factor.
struct Product {
  double factor;
  std::vector<double> roots;
  double operator()(double x) const {
    double value = factor;
    for (const double root : roots) value *= x - root;
    return value;
  }
};

template <class Guard>
std::optional<double> crossing(const Guard& guard, double low = 0.0, double high = 1.0) {
  return first_crossing(guard, low, high, guard(low), guard(high));
}

TEST(FirstCrossing, IsTheFirstOutgoingRootOfRandomPolynomials) {
  std::mt19937_64 random(20261122);
  std::uniform_real_distribution<double> place(-0.5, 1.5);
  int crossings = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    Product guard{-1.0, {}};
    const int degree = 1 + static_cast<int>(random() % 7);
    for (int i = 0; i < degree; ++i) guard.roots.push_back(place(random));
    if (guard(0.0) > 0.0) guard.factor = 1.0;
    std::sort(guard.roots.begin(), guard.roots.end());
    // It is negative at 0, so that the first root from there on leads outwards.
    const auto first = std::upper_bound(guard.roots.begin(), guard.roots.end(), 0.0);
    const auto found = crossing(guard);
    const bool seen = first != guard.roots.end() && *first < 1.0;
    const auto next = seen ? first + 1 : first;
    const bool separate = !seen || next == guard.roots.end() || *next - *first > 1e-5;
    if (!separate) continue;
    ASSERT_EQ(found.has_value(), seen) << trial;
    if (!found) continue;
    ++crossings;
    EXPECT_NEAR(*found, *first, 1e-9) << trial;
  }
  EXPECT_GT(crossings, 10000);
}

TEST(FirstCrossing, FindsPairsOfRootsHoweverCloseDownToTheStatedResolution) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(0.01, 0.99);
  for (const double distance : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 4e-6}) {
    for (int trial = 0; trial < 300; ++trial) {
      const double root = place(random);
      if (root + distance >= 1.0) continue;
      // Negative at both ends, positive only between the two.
      const auto guard = [&](double x) { return -(x - root) * (x - root - distance) * (1.0 + x * x); };
      const auto found = crossing(guard);
      ASSERT_TRUE(found) << root << " " << distance;
      EXPECT_NEAR(*found, root, 1e-10) << distance;
    }
  }
}

TEST(FirstCrossing, IsNoneWhereAGuardOnlyTouchesZero) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> place(0.0, 1.0);
  for (int trial = 0; trial < 1000; ++trial) {
    const double root = place(random);
    const double depth = trial % 2 == 0 ? 0.0 : 1e-12;
    const auto guard = [&](double x) { return -(x - root) * (x - root) * (2.0 - x) - depth; };
    EXPECT_FALSE(crossing(guard)) << root;
  }
}

TEST(FirstCrossing, FindsBumpsOfATenthOfTheStepOfAFunctionThatIsNoPolynomial) {
  for (const double width : {0.3, 0.2, 0.1}) {
    for (double centre = 0.05; centre < 1.0; centre += 0.0371) {
      const auto guard = [&](double x) {
        return std::exp(-std::pow((x - centre) / width, 2)) - 0.5 + 0.01 * std::sin(7.0 * x);
      };
      if (guard(0.0) > 0.0) continue;
      const auto found = crossing(guard);
      ASSERT_TRUE(found) << width << " " << centre;
      double expected = 0.0;
      while (guard(expected) <= 0.0) expected += 1e-5;
      EXPECT_NEAR(*found, expected, 1e-5);
    }
  }
}

TEST(FirstCrossing, OfTwoBumpsIsTheFirst) {
  const auto guard = [](double x) { return std::sin(9.0 * std::numbers::pi * x - 2.0) - 0.9; };
  const auto found = crossing(guard);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, (2.0 + std::asin(0.9)) / (9.0 * std::numbers::pi), 1e-12);
}

TEST(FirstCrossing, AsksAFarGuardForOneSetOfSamplesOnly) {
  int evaluations = 0;
  const auto guard = [&](double x) {
    ++evaluations;
    return -1.0 + 0.5 * std::sin(2.0 * x);
  };
  EXPECT_FALSE(first_crossing(guard, 0.0, 1.0, -1.0, -0.5));
  EXPECT_EQ(evaluations, 8);
}

TEST(FirstCrossing, BoundsItsWorkWhereOnlyRoundingIsLeft) {
  std::mt19937_64 random(3);
  int evaluations = 0;
  std::uniform_real_distribution<double> noise(-1e-12, 1e-12);
  const auto guard = [&](double x) {
    ++evaluations;
    return noise(random) - 1e-3 * std::pow(x - 0.5, 6);
  };
  first_crossing(guard, 0.0, 1.0, -1.0, -1.0);
  EXPECT_LT(evaluations, 15000);
  const auto nothing = [](double) { return 0.0; };
  EXPECT_FALSE(first_crossing(nothing, 0.0, 1.0, 0.0, 0.0));
}

TEST(FirstCrossing, IsTheStartWhereTheGuardIsPositiveThere) {
  const auto guard = [](double x) { return 0.5 - x; };
  EXPECT_EQ(crossing(guard), 0.0);
}

TEST(FirstCrossing, IsNotWhereTheGuardIsNotANumber) {
  const auto guard = [](double x) {
    return x < 0.7 ? -(x - 0.3) * (x - 0.31) : std::numeric_limits<double>::quiet_NaN();
  };
  const auto found = crossing(guard);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, 0.3, 1e-12);
  const auto nowhere = [](double x) { return x < 0.7 ? -1.0 : std::numeric_limits<double>::quiet_NaN(); };
  EXPECT_FALSE(crossing(nowhere));
}

TEST(FirstSignChange, IsTheNextRootOfAFunctionThatStartsAtZero) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(0.001, 0.99);
  for (int trial = 0; trial < 1000; ++trial) {
    const double root = place(random);
    const double sign = trial % 2 == 0 ? 1.0 : -1.0;
    // Zero at the start but for rounding, and again at `root`, in one case once more at the end.
    const auto velocity = [&](double x) {
      return sign * (x * (x - root) * (trial % 3 == 0 ? 0.999 - x : 2.0 + std::cos(3.0 * x)) + 1e-17);
    };
    const auto mean = [&](double x) { return velocity(x) / x; };
    const auto found = first_sign_change(mean, 0.0, 1.0, velocity(1.0));
    ASSERT_TRUE(found) << root;
    EXPECT_NEAR(*found, root, 1e-10);
  }
}

TEST(FirstSignChange, IsNoneOfAFunctionThatLeavesZeroForGood) {
  for (const double sign : {1.0, -1.0}) {
    const auto mean = [&](double x) { return sign * (1.0 + 0.5 * std::sin(5.0 * x)); };
    EXPECT_FALSE(first_sign_change(mean, 0.0, 1.0, mean(1.0)));
  }
}

TEST(CubicRange, EnclosesSinusoidsOfUpToThreeRadiansInAStep) {
  for (double angle = 0.05; angle <= 3.0; angle += 0.05) {
    for (double phase = 0.0; phase < 2.0 * std::numbers::pi; phase += 0.05) {
      const Range range = cubic_range(std::sin(phase), angle * std::cos(phase), std::sin(phase + angle),
                                      angle * std::cos(phase + angle));
      for (double part = 0.0; part <= 1.0; part += 0.02) {
        const double value = std::sin(phase + angle * part);
        ASSERT_LE(range.least, value) << angle << " " << phase;
        ASSERT_GE(range.greatest, value) << angle << " " << phase;
      }
    }
  }
}

}  // namespace
}  // namespace rubatlas::integrate

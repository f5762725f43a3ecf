/// Steps that cannot jump a touch-down, however grazing, and the root between two points.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <random>

#include "integrate/conservative_step.hpp"
#include "integrate/root_between.hpp"

namespace rubatlas::integrate {
namespace {

constexpr long double kEpsilon = std::numeric_limits<double>::epsilon();

struct Cubic {
  long double value, slope, curvature, third;
  [[nodiscard]] long double at(long double t) const {
    return value + t * (slope + t * (curvature / 2 + t * (third / 6)));
  }
  [[nodiscard]] long double rate(long double t) const { return slope + t * (curvature + t * (third / 2)); }
  /// Largest value over [0, end].
  [[nodiscard]] long double largest(long double end) const {
    long double result = std::max(at(0), at(end));
    const long double discriminant = curvature * curvature - 2 * third * slope;
    if (discriminant >= 0) {
      const long double half = -(curvature + std::copysign(std::sqrt(discriminant), curvature));
      for (const long double t : {third != 0 ? half / third : -1, half != 0 ? 2 * slope / half : -1}) {
        if (t > 0 && t < end) result = std::max(result, at(t));
      }
    }
    return result;
  }
  /// What double precision can know of it at t.
  [[nodiscard]] long double noise(long double t) const {
    return 4 * kEpsilon *
           (std::abs(value) +
            t * (std::abs(slope) + t * (std::abs(curvature) / 2 + t * std::abs(third) / 6)));
  }
};

/// Random Taylor coefficients over many magnitudes.
class RandomCubics {
 public:
  explicit RandomCubics(std::uint64_t seed) : random_(seed) {}
  double uniform() { return uniform_(random_); }
  double magnitude() { return std::pow(10.0, 8 * uniform() - 6); }
  double sign() { return uniform() < 0.5 ? -1.0 : 1.0; }
  Cubic next(double third) { return {-magnitude(), sign() * magnitude(), sign() * magnitude(), third}; }

 private:
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
};

double step_of(const Cubic& g, double third_bound) {
  return conservative_step(static_cast<double>(g.value), static_cast<double>(g.slope),
                           static_cast<double>(g.curvature), third_bound);
}

TEST(ConservativeStep, NeverPassesTheFirstRootOfAFunctionWithinTheBound) {
  RandomCubics random(31);
  for (int i = 0; i < 100000; ++i) {
    const double bound = random.magnitude();
    const Cubic g = random.next(bound * (2 * random.uniform() - 1));
    const long double step = step_of(g, bound);
    ASSERT_GT(step, 0.0L) << i;
    const Cubic majorant{g.value, g.slope, g.curvature, bound};
    ASSERT_LE(g.largest(step), majorant.noise(step)) << i;
  }
}

TEST(ConservativeStep, ReachesTheRootWhereTheFunctionIsItsMajorant) {
  // Just behind the step the cubic is positive: within 1e-12 of the first root, plus what rounding hides of
  // it.
  RandomCubics random(32);
  for (int i = 0; i < 100000; ++i) {
    const double bound = random.magnitude();
    const Cubic g = random.next(bound);
    const long double step = step_of(g, bound);
    const long double behind = step * (1 + 4e-12L);
    ASSERT_GE(std::max(g.at(behind), g.largest(behind)), -g.noise(behind)) << i;
  }
}

TEST(ConservativeStep, DoesNotMissAGrazingMaximum) {
  // Majorants that touch zero at t = top with a maximum of the given height: the step must end before a
  // positive one, and go on beyond a negative one.
  RandomCubics random(33);
  for (int i = 0; i < 100000; ++i) {
    const double top = random.magnitude();
    const double bound = random.magnitude();
    const double depth = std::pow(10.0, -3 - 9 * random.uniform());
    const double curvature_there = -bound * top * (0.1 + random.uniform());
    // Expanded about the top, then moved to t = 0 (h'' < 0 there and h''' = bound).
    const Cubic about{0.0L, 0.0L, curvature_there, bound};
    const long double scale = std::abs(about.at(-top));
    for (const double side : {1.0, -1.0}) {
      Cubic g{about.at(-top) + side * depth * scale, about.rate(-top),
              curvature_there - static_cast<long double>(bound) * top, bound};
      // To binary64, as the function sees them.
      g = {static_cast<double>(g.value), static_cast<double>(g.slope), static_cast<double>(g.curvature),
           bound};
      if (g.value >= 0.0L) continue;
      const double step = step_of(g, bound);
      if (side > 0) {
        ASSERT_LT(step, top) << i << ", depth " << depth;
      } else {
        ASSERT_GT(step, top) << i << ", depth " << depth;
      }
    }
  }
}

TEST(ConservativeStep, IsZeroOnlyWhereTheFunctionRises) {
  EXPECT_EQ(conservative_step(0.0, 1.0, 0.0, 1.0), 0.0);
  EXPECT_EQ(conservative_step(0.0, 1e-12, -1.0, 1.0), 0.0);
  // Leaving zero: −t + t³/6 comes back at sqrt(6); −t²/2 + t³/6 at 3.
  EXPECT_NEAR(conservative_step(0.0, -1.0, 0.0, 1.0), std::sqrt(6.0), 1e-11);
  EXPECT_NEAR(conservative_step(0.0, 0.0, -1.0, 1.0), 3.0, 1e-11);
}

/// Follows amplitude cos(t + phase) − level until it could become positive, or to the horizon.
std::optional<double> first_touch(double phase, double level, double horizon) {
  double t = 0.0;
  for (int i = 0; i < 100000 && t < horizon; ++i) {
    const double gap = std::cos(t + phase) - level;
    const double slope = -std::sin(t + phase);
    if (gap >= 0.0 && slope > 0.0) return t;
    const double step = conservative_step(std::min(gap, 0.0), slope, -std::cos(t + phase), 1.0);
    if (step <= 2 * static_cast<double>(kEpsilon) * std::max(1.0, t)) return t;
    t += step;
  }
  return std::nullopt;
}

TEST(ConservativeStep, FindsEveryGrazingTouchDownOfASweptHarmonicMotion) {
  // A sign test of samples sees a depth of 1e-6 for 1e-3 of a period: 2 of these 401.
  for (const double depth : {1e-3, 1e-6, 1e-9, 1e-12}) {
    int found = 0;
    for (int k = 0; k <= 400; ++k) {
      const double phase = 0.1 + 5.9 * k / 400;
      const double level = 1.0 - depth;
      const auto time = first_touch(phase, level, 2 * std::numbers::pi);
      if (!time) continue;
      ++found;
      // cos(t + phase) = level on the rising side of the maximum at 2π; a rounding of the gap is worth
      // eps/slope.
      const long double exact =
          2 * std::numbers::pi_v<long double> - phase - std::acos(static_cast<long double>(level));
      const long double allowed = 4 * kEpsilon * (2 * std::numbers::pi + 1 / std::sqrt(2 * depth));
      EXPECT_LE(std::abs(*time - exact), allowed) << "depth " << depth << ", phase " << phase;
    }
    EXPECT_EQ(found, 401) << depth;
  }
}

TEST(ConservativeStep, ReportsNoTouchDownWhereTheMotionStaysClear) {
  for (const double depth : {1e-3, 1e-6, 1e-9, 1e-12}) {
    for (int k = 0; k <= 400; ++k) {
      const double phase = 0.1 + 5.9 * k / 400;
      EXPECT_FALSE(first_touch(phase, 1.0 + depth, 2 * std::numbers::pi).has_value())
          << depth << ", " << phase;
    }
  }
}

TEST(RootBetween, FindsTheRootToTheLastBits) {
  const auto function = [](double t) { return std::cos(t) - t; };
  const double root = root_between(function, 0.0, 1.0, function(0.0), function(1.0));
  EXPECT_NEAR(root, 0.7390851332151606416553, 2e-16);
}

TEST(RootBetween, FindsRootsOfHighMultiplicityAndSteepOnes) {
  const auto flat = [](double t) { return std::pow(t - 0.3, 9); };
  const double found = root_between(flat, 0.0, 1.0, flat(0.0), flat(1.0));
  EXPECT_NEAR(found, 0.3, 1e-9);
  const auto steep = [](double t) { return std::atan(1e9 * (t - 0.7)); };
  EXPECT_NEAR(root_between(steep, 0.0, 1.0, steep(0.0), steep(1.0)), 0.7, 3e-16);
}

TEST(RootBetween, AValueThatIsNoNumberEndsTheSearchWithoutAnException) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto line = [](double x) { return x - 0.5; };
  EXPECT_EQ(root_between(line, 0.0, 1.0, -0.5, none), 1.0);
  EXPECT_EQ(root_between(line, 0.0, 1.0, none, 0.5), 1.0);
}

TEST(RootBetween, ReturnsAnEndThatIsARoot) {
  const auto function = [](double t) { return t - 0.25; };
  EXPECT_EQ(root_between(function, 0.25, 1.0, 0.0, 0.75), 0.25);
  EXPECT_EQ(root_between(function, 0.0, 0.25, -0.25, 0.0), 0.25);
}

TEST(RootBetween, ReturnsTheEndNearerToTheRootWhereRoundingHidesTheSignChange) {
  const auto function = [](double t) { return t + 1e-17; };
  EXPECT_EQ(root_between(function, 0.0, 1.0, 1e-17, 1.0), 0.0);
  EXPECT_EQ(root_between(function, -1.0, 0.0, 1.0, 1e-17), 0.0);
}

}  // namespace
}  // namespace rubatlas::integrate

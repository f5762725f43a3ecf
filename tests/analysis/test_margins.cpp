// Distances to borders, and grazings that the trend of the nearest miss predicts.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "analysis/rules/exponent_check.hpp"
#include "analysis/rules/margin_map.hpp"
#include "analysis/rules/margins.hpp"

namespace rubatlas::analysis {
namespace {

/// Points at `values` with the misses of a function and one class.
MotionsAlong points(const std::vector<double>& values, const std::function<double(double)>& miss,
                    std::uint8_t motion = 1) {
  MotionsAlong motions{.values = values, .motion = {}, .nearest_miss = {}};
  for (const double value : values) {
    motions.motion.push_back(motion);
    motions.nearest_miss.push_back(miss(value));
  }
  return motions;
}

constexpr double kRoot = 0.4393;

/// Falls to zero at `kRoot`, along a parabola.
double falling(double value) {
  return 0.14 * (kRoot - value) + 0.3 * (kRoot - value) * (kRoot - value);
}

TEST(Margins, AMissThatFallsAlongAParabolaGrazesAtItsRoot) {
  // Unequal steps: the trend is one over the parameter, not over the numbers of the points.
  const auto motions = points({0.434, 0.436, 0.4365, 0.438, 0.4385}, falling);
  for (const std::size_t point : {2U, 3U, 4U}) {
    const auto grazing = predicted_grazing(motions, point);
    ASSERT_TRUE(grazing);
    EXPECT_NEAR(grazing->at, kRoot, 1e-14);
    EXPECT_GT(grazing->error, 0.0);
    EXPECT_EQ(grazing->from, (std::array<std::size_t, 3>{point, point - 1, point - 2}));
  }
  // No two neighbours show a trend.
  EXPECT_FALSE(predicted_grazing(motions, 0));
  EXPECT_FALSE(predicted_grazing(motions, 1));
}

TEST(Margins, AMissThatFallsTowardsLowerValuesGrazesBelow) {
  const auto motions = points({0.45, 0.46, 0.47}, [](double value) { return 2.0 * (value - 0.4475); });
  const auto grazing = predicted_grazing(motions, 0);
  ASSERT_TRUE(grazing);
  EXPECT_NEAR(grazing->at, 0.4475, 1e-14);
  EXPECT_FALSE(predicted_grazing(motions, 2)) << "away from the grazing";
}

TEST(Margins, AMissThatGrowsOrTurnsBackBeforeTheRingGrazesNowhere) {
  const std::vector<double> values{1.0, 2.0, 3.0, 4.0};
  const auto turns = points(values, [](double value) { return 1.0 + (value - 5.0) * (value - 5.0); });
  const auto level = points(values, [](double) { return 1.0; });
  for (std::size_t point = 0; point < values.size(); ++point) {
    EXPECT_FALSE(predicted_grazing(turns, point));
    EXPECT_FALSE(predicted_grazing(level, point));
  }
}

TEST(Margins, WhatIsKnownAheadContradictsATrend) {
  // At 4 another tip passes the ring: the first one has changed its course.
  auto motions = points({1.0, 2.0, 3.0, 4.0, 5.0}, [](double value) { return 5.5 - value; });
  EXPECT_NEAR(predicted_grazing(motions, 2)->at, 5.5, 1e-14);
  motions.nearest_miss[3] = 3.0;
  EXPECT_FALSE(predicted_grazing(motions, 2));
  motions.nearest_miss[3] = 1.5;
  motions.motion[3] = 3;
  EXPECT_FALSE(predicted_grazing(motions, 2)) << "another motion in between";
}

TEST(Margins, ChaoticMotionsHaveNoTrend) {
  const auto motions = points({0.437, 0.438, 0.439}, falling, motion_class::kAperiodic);
  EXPECT_FALSE(predicted_grazing(motions, 2));
}

TEST(Margins, AGrazingBelongsToTheBorderAtWhichItLies) {
  auto motions = points({0.436, 0.437, 0.438, 0.439, 0.44, 0.441}, falling);
  motions.motion[4] = motions.motion[5] = motion_class::kAperiodic;
  const auto borders = find_borders(motions.motion);
  ASSERT_EQ(borders.size(), 1U);
  const auto grazing = grazing_at(motions, borders.front());
  ASSERT_TRUE(grazing);
  EXPECT_NEAR(grazing->at, kRoot, 1e-14);
  // The motion changes a step earlier than the miss says: by something else.
  motions.motion[3] = motion_class::kAperiodic;
  EXPECT_FALSE(grazing_at(motions, find_borders(motions.motion).front()));
}

TEST(Margins, DistancesToBordersAreThoseToTheMiddleOfTheirSteps) {
  MotionsAlong motions{.values = {1.0, 2.0, 4.0, 5.0, 6.0}, .motion = {1, 1, 2, 2, 2}, .nearest_miss = {}};
  EXPECT_EQ(distances_to_borders(motions), (std::vector<double>{2.0, 1.0, 1.0, 2.0, 3.0}));
  motions.motion = {1, 1, 1, 1, motion_class::kNone};
  for (const double distance : distances_to_borders(motions)) EXPECT_TRUE(std::isnan(distance));
}

TEST(MarginMap, LooksAlongEveryParameterThatIsSwept) {
  // Two dampings, three speeds, both ways; class and miss as prescribed.
  const std::vector<plan::Axis> axes{{"direction", {0.0, 1.0}, "1", ""},
                                     {"damping_ratio", {0.1, 0.3}, "1", ""},
                                     {"friction", {0.1}, "1", ""},
                                     {"speed_ratio", {1.0, 2.0, 3.0}, "1", ""}};
  const MarginRows rows{.motion = {1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2},
                        .nearest_miss = {3.0, 2.0, 1.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0},
                        .miss_side = {}};
  const auto margins = find_margins(axes, rows, {});
  ASSERT_EQ(margins.axes.size(), 2U);
  EXPECT_EQ(margins.axes[0].axis, 1U);
  EXPECT_EQ(margins.axes[1].axis, 3U);
  EXPECT_NEAR(margins.axes[0].to_border[2], 0.1, 1e-15);
  EXPECT_NEAR(margins.axes[0].to_border[5], 0.1, 1e-15);
  EXPECT_TRUE(std::isnan(margins.axes[0].to_border[0]));
  EXPECT_EQ(margins.axes[1].to_border[3], 1.5);
  EXPECT_TRUE(std::isnan(margins.axes[1].to_border[0]));
  EXPECT_NEAR(margins.axes[1].to_grazing[2], 1.0, 1e-15);
  EXPECT_TRUE(std::isnan(margins.axes[1].to_grazing[5]));
}

TEST(ExponentCheck, HoldsTheSignOfTheExponentAgainstTheClass) {
  EXPECT_EQ(check_exponent(1, -0.1, 1e-9), ExponentCheck::agrees);
  EXPECT_EQ(check_exponent(motion_class::kAperiodic, 0.1, 0.01), ExponentCheck::agrees);
  EXPECT_EQ(check_exponent(16, 0.1, 0.01), ExponentCheck::disagrees);
  EXPECT_EQ(check_exponent(motion_class::kAperiodic, -0.1, 0.01), ExponentCheck::disagrees);
  EXPECT_EQ(check_exponent(motion_class::kAperiodic, 0.01, 0.01), ExponentCheck::undecided);
  EXPECT_EQ(check_exponent(motion_class::kUnresolved, -0.1, 1e-9), ExponentCheck::none);
  EXPECT_EQ(check_exponent(1, std::nan(""), 1e-9), ExponentCheck::none);
}

}  // namespace
}  // namespace rubatlas::analysis

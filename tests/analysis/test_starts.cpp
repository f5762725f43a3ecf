// Points that differ in their start only: basins of attraction, and sweeps both ways.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "analysis/rules/basins.hpp"
#include "analysis/rules/hysteresis.hpp"
#include "analysis/rules/line.hpp"
#include "analysis/rules/starts.hpp"

namespace rubatlas::analysis {
namespace {

plan::Axis axis(const std::string& name, std::size_t extent) {
  plan::Axis result{.name = name, .values = {}, .units = "1", .long_name = {}};
  for (std::size_t i = 0; i < extent; ++i) result.values.push_back(0.1 * static_cast<double>(i + 1));
  return result;
}

constexpr std::uint8_t kWandering = motion_class::kAperiodic;

TEST(SetsOfStarts, HoldThePointsThatShareAllButTheInitialState) {
  const std::vector<plan::Axis> axes{axis("initial_vx", 2), axis("rotor_mass", 3), axis("initial_x", 2),
                                     axis("speed_ratio", 2)};
  const Starts starts(axes);
  EXPECT_TRUE(starts.several());
  EXPECT_EQ(starts.set_count(), 6U);
  EXPECT_EQ(starts.parameter_axes(), (std::vector<std::size_t>{1, 3}));
  for (std::size_t point = 0; point < 24; ++point) {
    EXPECT_EQ(starts.set_of(point), point / 4 % 3 * 2 + point % 2) << point;
  }
}

TEST(SetsOfStarts, HoldBothDirectionsOfASweep) {
  const std::vector<plan::Axis> axes{axis("direction", 2), axis("friction", 2), axis("speed_ratio", 3)};
  const Starts starts(axes);
  for (std::size_t point = 0; point < 12; ++point) EXPECT_EQ(starts.set_of(point), point % 6);
  const std::vector<plan::Axis> others{axis("initial_x", 1), axis("speed_ratio", 3)};
  EXPECT_FALSE(Starts(others).several());
}

TEST(BasinsOfAttraction, AreSharesOfTheInitialStatesWithTheirBinomialErrors) {
  const std::vector<plan::Axis> axes{axis("initial_x", 5), axis("speed_ratio", 2)};
  // Second speed: pending, left the model, not resolved, and two aperiodic motions.
  const std::vector<std::uint8_t> status{1, 0, 1, 2, 1, 1, 1, 1, 1, 1};
  const std::vector<std::uint8_t> motion{1, 0, 3, 0, 1, 254, 1, kWandering, 1, kWandering};
  const std::vector<std::int32_t> attractor{1, 0, 2, 0, 1, 0, 1, 1, 1, 1};
  const std::vector<double> displacement{1.0, NAN, 3.0, NAN, 1.0, 8.0, 1.0, 5.0, 1.0, 6.0};
  const auto basins = find_basins(Starts(axes), {status, motion, attractor, displacement});
  ASSERT_EQ(basins.size(), 4U);
  const auto expect = [&](std::size_t i, std::size_t set, std::int32_t number, std::uint8_t kind,
                          std::size_t points, double all, double largest) {
    const double share = static_cast<double>(points) / all;
    EXPECT_EQ(basins[i].set, set);
    EXPECT_EQ(basins[i].attractor, number);
    EXPECT_EQ(basins[i].motion, kind);
    EXPECT_EQ(basins[i].points, points);
    EXPECT_DOUBLE_EQ(basins[i].share, share);
    EXPECT_DOUBLE_EQ(basins[i].standard_error, std::sqrt(share * (1.0 - share) / all));
    EXPECT_TRUE(basins[i].max_displacement == largest || std::isnan(largest));
  };
  expect(0, 0, 1, 1, 4, 5.0, 1.0);
  expect(1, 0, 2, 3, 1, 5.0, 3.0);
  expect(2, 1, 1, kWandering, 2, 4.0, 6.0);  // one of five is pending
  expect(3, 1, 0, 0, 2, 4.0, NAN);
}

TEST(HysteresisOfASweep, IsWhereUpAndDownEndOnOtherAttractors) {
  const std::vector<double> speeds{0.1, 0.2, 0.3, 0.4, 0.5};
  const std::vector<std::uint8_t> motion{1, 1, 1, kWandering, 1, /* down: */ 1, 2, 4, kWandering, 1};
  const std::vector<std::int32_t> attractor{1, 1, 1, 1, 1, /* down: */ 1, 2, 2, 1, 1};
  const auto found = find_hysteresis(speeds, motion, attractor, std::vector<double>(10, 1.0));
  EXPECT_EQ(found.compared, 5U);
  EXPECT_EQ(found.different, 2U);
  EXPECT_EQ(found.compared_aperiodic, 1U);
  EXPECT_EQ(found.different_aperiodic, 0U);
  ASSERT_EQ(found.ranges.size(), 1U);
  const auto& range = found.ranges.front();
  EXPECT_EQ(range.from, 0.2);
  EXPECT_EQ(range.to, 0.3);
  EXPECT_EQ(range.speeds, 2U);
  EXPECT_EQ(range.up, (std::vector<std::uint8_t>{1}));
  EXPECT_EQ(range.down, (std::vector<std::uint8_t>{2, 4}));
  EXPECT_FALSE(range.may_be_shifted);
}

TEST(HysteresisOfASweep, ASpeedThatIsNotComparedDividesNoRangeAndTheEndOfALineDoes) {
  const std::vector<double> speeds{0.1, 0.2, 0.3};
  const std::vector<std::uint8_t> motion{3, 3, 3, 3, 3, 1, /* down: */ 3, 254, 3, 3, 1, 1};
  const std::vector<std::int32_t> attractor{1, 1, 1, 1, 1, 1, /* down: */ 2, 0, 2, 2, 2, 1};
  const std::vector<double> displacement{1, 1, 1, 1, 1, 1, /* down: */ 1, 1, 1, 1, 1, 1};
  const auto found = find_hysteresis(speeds, motion, attractor, displacement);
  ASSERT_EQ(found.ranges.size(), 2U);
  EXPECT_EQ(found.ranges[0].line, 0U);
  EXPECT_EQ(found.ranges[0].from, 0.1);
  EXPECT_EQ(found.ranges[0].to, 0.3);
  EXPECT_EQ(found.ranges[0].speeds, 2U);
  EXPECT_TRUE(found.ranges[0].may_be_shifted);
  EXPECT_EQ(found.ranges[1].line, 1U);
  EXPECT_EQ(found.ranges[1].from, 0.1);
  EXPECT_EQ(found.ranges[1].to, 0.2);
  EXPECT_FALSE(found.ranges[1].may_be_shifted);
}

}  // namespace
}  // namespace rubatlas::analysis

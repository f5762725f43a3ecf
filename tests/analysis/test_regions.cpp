// Regions of lines whose classes are prescribed.
#include "analysis/rules/regions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/rules/doublings.hpp"
#include "analysis/rules/median.hpp"
#include "analysis/rules/stretches.hpp"
#include "synthetic_line.hpp"

namespace rubatlas::analysis {
namespace {

std::array<Region, 4> regions_of_line(const Line& line, SpeedScale scale = kThreeBlades) {
  return find_regions(line, scale, find_triggers(line, scale, 1e-8));
}

std::array<Region, 4> regions_of(const std::vector<Piece>& pieces, std::size_t count = 901) {
  return regions_of_line(line_of(0.05, count, pieces));
}

void expect_extent(const Region& region, double from, double to, double tolerance = 1e-9) {
  EXPECT_EQ(region.presence, Presence::present);
  EXPECT_NEAR(region.from, from, tolerance);
  EXPECT_NEAR(region.to, to, tolerance);
}

TEST(Regions, AreTheFourOfThePapersPicture) {
  const auto regions = regions_of(four_regions());
  expect_extent(regions[0], 0.05, 0.333);
  expect_extent(regions[1], 0.334, 0.55, 1.1e-3);  // its last point is a window
  expect_extent(regions[2], 0.55, 0.666, 1.1e-3);
  expect_extent(regions[3], 0.667, 0.95);
  EXPECT_DOUBLE_EQ(regions[0].aperiodic_share, 0.0);
  EXPECT_NEAR(regions[1].aperiodic_share, 0.8, 0.01);
  EXPECT_NEAR(regions[2].aperiodic_share, 0.0, 1e-12);
  EXPECT_DOUBLE_EQ(regions[3].aperiodic_share, 1.0);
  EXPECT_DOUBLE_EQ(regions[0].peak_displacement, 1e-4);
  EXPECT_DOUBLE_EQ(regions[1].peak_displacement, 1e-2);
  EXPECT_DOUBLE_EQ(regions[2].peak_displacement, 5e-3);
  EXPECT_DOUBLE_EQ(regions[3].peak_displacement, 2e-2);
}

TEST(Regions, HaveTheMeanOfTheMiddleTwoAsTheMedianOfAnEvenNumberOfPoints) {
  EXPECT_EQ(median({4.0, 1.0, 3.0}), 3.0);
  EXPECT_EQ(median({8.0, 1.0, 2.0, 3.0}), 2.5);
  EXPECT_TRUE(std::isnan(median({})));
}

TEST(Regions, ScaleWithTheNumberOfBlades) {
  auto line = line_of(0.05, 901, four_regions());
  const auto three = regions_of_line(line);
  for (auto& speed : line.speed_ratio) speed *= 0.5;
  const auto six = regions_of_line(line, SpeedScale(6));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(six[i].presence, three[i].presence);
    EXPECT_DOUBLE_EQ(six[i].from, 0.5 * three[i].from);
    EXPECT_DOUBLE_EQ(six[i].to, 0.5 * three[i].to);
  }
}

TEST(Regions, AreNotBrokenByAWindowOrMadeByOneAperiodicPoint) {
  auto line = line_of(0.05, 901, four_regions());
  for (std::size_t i = 400; i < 415; ++i) line.motion[i] = 3;  // a window of 0.015 in region 2
  line.motion[550] = 255;                                      // one point of chaos in region 3
  line.motion[100] = 255;                                      // and one in region 1
  const auto regions = regions_of_line(line);
  expect_extent(regions[1], 0.334, 0.55, 1.1e-3);
  expect_extent(regions[2], 0.55, 0.666, 1.1e-3);
  EXPECT_NEAR(regions[2].aperiodic_share, 1.0 / 117.0, 1e-3);
  EXPECT_NEAR(regions[0].aperiodic_share, 1.0 / 284.0, 1e-4);
}

TEST(Regions, JoinChaosAcrossAWindowThatIsShorterThanBothSides) {
  const auto joined = regions_of(
      {{0.3335, {1}, 1e-4}, {0.42, {255}, 1e-2}, {0.48, {3}, 1e-2}, {0.60, {255}, 1e-2}, {0.95, {1}, 1e-2}});
  expect_extent(joined[1], 0.334, 0.60);
  EXPECT_NEAR(joined[1].aperiodic_share, 1.0 - 60.0 / 267.0, 1e-9);
  const auto apart = regions_of(
      {{0.3335, {1}, 1e-4}, {0.37, {255}, 1e-2}, {0.48, {3}, 1e-2}, {0.60, {255}, 1e-2}, {0.95, {1}, 1e-2}});
  expect_extent(apart[1], 0.481, 0.60);
}

TEST(Regions, TwoAndFourAreAbsentOnALineThatIsPeriodicThroughout) {
  const auto regions = regions_of({{0.3335, {1}, 1e-4}, {0.95, {1, 2}, 1e-2}});
  expect_extent(regions[0], 0.05, 0.333);
  EXPECT_EQ(regions[1].presence, Presence::absent);
  EXPECT_EQ(regions[3].presence, Presence::absent);
  expect_extent(regions[2], 0.334, 0.95);
  EXPECT_DOUBLE_EQ(regions[1].width(), 0.0);
  EXPECT_TRUE(std::isnan(regions[1].from));
}

TEST(Regions, ThreeIsAbsentAndFourMergedWhereChaosGoesThrough) {
  const auto regions = regions_of({{0.3335, {1}, 1e-4}, {0.95, {255}, 1e-2}});
  expect_extent(regions[1], 0.334, 0.95);
  EXPECT_EQ(regions[2].presence, Presence::absent);
  EXPECT_EQ(regions[3].presence, Presence::merged);
}

TEST(Regions, FourIsMergedWithNoTwoThatTouchesNowhere) {
  Line line = line_of(0.05, 901, {{0.3335, {1}, 1e-4}, {0.95, {255}, 1e-2}});
  line.contact.assign(line.size(), PointContact{.contact = Contact::none});
  const auto regions = regions_of_line(line);
  EXPECT_EQ(regions[1].presence, Presence::absent);
  EXPECT_NE(regions[3].presence, Presence::merged);
}

TEST(Regions, ThreeMayBeSqueezedBetweenChaosAndChaos) {
  const auto regions =
      regions_of({{0.3335, {1}, 1e-4}, {0.53, {255}, 1e-2}, {0.57, {1}, 1e-2}, {0.95, {255}, 2e-2}});
  expect_extent(regions[1], 0.334, 0.53);
  expect_extent(regions[2], 0.531, 0.57);
  expect_extent(regions[3], 0.571, 0.95);
}

TEST(Regions, TwoMayBeginLateAndFourEarly) {
  const auto late = regions_of(
      {{0.3335, {1}, 1e-4}, {0.53, {6}, 1e-2}, {0.60, {255}, 1e-2}, {0.68, {1}, 1e-2}, {0.95, {255}, 2e-2}});
  expect_extent(late[1], 0.531, 0.60);
  expect_extent(late[2], 0.601, 0.68);
  expect_extent(late[3], 0.681, 0.95);
  const auto early = regions_of({{0.3335, {1}, 1e-4}, {0.52, {1}, 1e-2}, {0.95, {255}, 2e-2}});
  EXPECT_EQ(early[1].presence, Presence::absent);
  expect_extent(early[2], 0.334, 0.52);
  expect_extent(early[3], 0.521, 0.95);
}

TEST(Regions, EndOpenAtAGap) {
  auto pieces = four_regions();
  pieces[1] = {0.45, {255}, 1e-2};
  pieces.insert(pieces.begin() + 2, {0.55, {motion_class::kNone}, kNotANumber});
  const auto regions = regions_of(pieces);
  expect_extent(regions[1], 0.334, 0.45);
  EXPECT_FALSE(regions[1].begins_open);
  EXPECT_TRUE(regions[1].ends_open);
  EXPECT_TRUE(std::isnan(regions[1].width()));
  expect_extent(regions[2], 0.551, 0.666);
  EXPECT_TRUE(regions[2].begins_open);
  EXPECT_FALSE(regions[2].ends_open);
}

TEST(Regions, AreOpenWhereTheGridEnds) {
  const auto regions = regions_of(four_regions());
  expect_extent(regions[0], 0.05, 0.333);
  EXPECT_TRUE(regions[0].begins_open);
  EXPECT_FALSE(regions[0].ends_open);
  EXPECT_FALSE(std::isnan(regions[1].width()));
  EXPECT_FALSE(std::isnan(regions[2].width()));
  expect_extent(regions[3], 0.667, 0.95);
  EXPECT_FALSE(regions[3].begins_open);
  EXPECT_TRUE(regions[3].ends_open);
  EXPECT_TRUE(std::isnan(regions[3].width()));
}

TEST(Regions, AreOpenWhereTheLastPointsOfTheGridAreNotDoneOrUnresolved) {
  for (const auto last : {motion_class::kNone, motion_class::kUnresolved}) {
    auto pieces = four_regions();
    pieces.back().to = 0.94;
    pieces.push_back({0.95, {last}, 2e-2});
    const auto regions = regions_of(pieces);
    expect_extent(regions[3], 0.667, 0.94);
    EXPECT_TRUE(regions[3].ends_open);
  }
}

TEST(Regions, AreClosedBeforePeriodicMotionAtTheEndOfTheGrid) {
  auto pieces = four_regions();
  pieces.back().to = 0.85;
  pieces.push_back({0.95, {1}, 2e-2});
  const auto regions = regions_of(pieces);
  expect_extent(regions[3], 0.667, 0.85);
  EXPECT_FALSE(regions[3].ends_open);
}

TEST(Regions, GoOnAcrossAGapThatIsShorterThanTheChaosOnBothSides) {
  const auto regions = regions_of({{0.3335, {1}, 1e-4},
                                   {0.45, {255}, 1e-2},
                                   {0.50, {motion_class::kNone}, kNotANumber},
                                   {0.60, {255}, 1e-2},
                                   {0.67, {1}, 1e-2},
                                   {0.95, {255}, 2e-2}});
  expect_extent(regions[1], 0.334, 0.60);
  EXPECT_FALSE(regions[1].begins_open || regions[1].ends_open);
  expect_extent(regions[2], 0.601, 0.67);
}

TEST(Regions, LeaveChaosBesideThePeriodicStretchToNone) {
  // The rig's picture: a short burst between regions 2 and 3 belongs to neither.
  const auto regions = regions_of({{0.3335, {1}, 1e-4},
                                   {0.45, {255}, 1e-2},
                                   {0.52, {1}, 1e-2},
                                   {0.55, {255}, 1e-2},
                                   {0.65, {1}, 1e-2},
                                   {0.95, {255}, 2e-2}});
  expect_extent(regions[1], 0.334, 0.45);
  expect_extent(regions[2], 0.551, 0.65);
  expect_extent(regions[3], 0.651, 0.95);
  EXPECT_DOUBLE_EQ(regions[2].aperiodic_share, 0.0);
}

TEST(Regions, AreNotCalledAbsentWhereAGapMayHideThem) {
  // Chaos may be what left the model's validity between 0.40 and 0.48, and beyond 0.70.
  const auto nothing = motion_class::kNone;
  const auto regions = regions_of({{0.3335, {1}, 1e-4},
                                   {0.40, {1}, 1e-2},
                                   {0.48, {nothing}, kNotANumber},
                                   {0.70, {1}, 1e-2},
                                   {0.95, {nothing}, kNotANumber}});
  EXPECT_EQ(regions[1].presence, Presence::not_covered);
  expect_extent(regions[2], 0.481, 0.70);
  EXPECT_TRUE(regions[2].begins_open && regions[2].ends_open);
  EXPECT_EQ(regions[3].presence, Presence::not_covered);
}

TEST(Regions, AreNotCalledAbsentWhereAGapGoesOnToTheirEnd) {
  // A few periodic points above the trigger, then nothing until region 3.
  const auto regions = regions_of({{0.3335, {1}, 1e-4},
                                   {0.345, {1}, 1e-2},
                                   {0.64, {motion_class::kNone}, kNotANumber},
                                   {0.68, {1}, 1e-2},
                                   {0.95, {255}, 2e-2}});
  EXPECT_EQ(regions[1].presence, Presence::not_covered);
  expect_extent(regions[2], 0.641, 0.68);
}

TEST(Regions, AreNotCalledAbsentWhereTheirPlaceIsPendingUpToTheFirstPoint) {
  // The line was computed from the top down to 0.45: chaos may be at the pending speeds.
  const auto pending = regions_of({{0.45, {motion_class::kNone}, kNotANumber}, {0.95, {1}, 1e-2}});
  EXPECT_EQ(pending[1].presence, Presence::not_covered);
  EXPECT_EQ(pending[3].presence, Presence::absent);
  const auto begins_late = regions_of_line(line_of(0.45, 501, {{0.95, {1}, 1e-2}}));
  EXPECT_EQ(begins_late[1].presence, Presence::not_covered);
  const auto over_the_start = regions_of({{0.32, {1}, 1e-2},
                                          {0.45, {motion_class::kNone}, kNotANumber},
                                          {0.62, {1}, 1e-2},
                                          {0.75, {motion_class::kNone}, kNotANumber},
                                          {0.95, {1}, 1e-2}});
  EXPECT_EQ(over_the_start[1].presence, Presence::not_covered);
  EXPECT_EQ(over_the_start[3].presence, Presence::not_covered);
}

TEST(Regions, DoNotMindSinglePointsThatAreNotDone) {
  auto line = line_of(0.05, 901, four_regions());
  for (std::size_t i = 0; i < line.size(); i += 10) {
    line.motion[i] = motion_class::kNone;
    line.max_displacement[i] = kNotANumber;
  }
  const auto regions = regions_of_line(line);
  for (const auto& region : regions) EXPECT_EQ(region.presence, Presence::present);
  EXPECT_FALSE(regions[0].ends_open || regions[3].begins_open);
  for (const auto& region : {regions[1], regions[2]}) EXPECT_FALSE(region.begins_open || region.ends_open);
}

TEST(Regions, OneIsAbsentWithoutTheFirstTrigger) {
  const auto regions = regions_of({{0.95, {1}, 1e-3}});
  EXPECT_EQ(regions[0].presence, Presence::absent);
  EXPECT_EQ(regions[1].presence, Presence::absent);
  expect_extent(regions[2], 0.251, 0.95);
}

TEST(Regions, KeepSmallChaosBelowTheFirstTriggerInRegionOne) {
  const auto regions = regions_of(
      {{0.30, {1}, 1e-4}, {0.3335, {255}, 1e-4}, {0.40, {1}, 1e-2}, {0.50, {255}, 1e-2}, {0.95, {1}, 1e-2}});
  expect_extent(regions[0], 0.05, 0.333);
  EXPECT_NEAR(regions[0].aperiodic_share, 33.0 / 284.0, 1e-9);
  expect_extent(regions[1], 0.401, 0.50);
}

TEST(Regions, AreNotCoveredWhereTheLineDoesNotReach) {
  const auto regions = regions_of({{0.3335, {1}, 1e-4}, {0.48, {255}, 1e-2}}, 431);
  expect_extent(regions[0], 0.05, 0.333);
  expect_extent(regions[1], 0.334, 0.48);
  EXPECT_EQ(regions[2].presence, Presence::not_covered);
  EXPECT_EQ(regions[3].presence, Presence::not_covered);
  EXPECT_TRUE(std::isnan(regions[2].width()));
}

TEST(Regions, AreNotCoveredOnALineWithoutClasses) {
  for (const std::uint8_t nothing : {motion_class::kNone, motion_class::kUnresolved}) {
    for (const auto& region : regions_of({{0.3335, {nothing}, 1e-4}, {0.95, {nothing}, 1e-2}})) {
      EXPECT_EQ(region.presence, Presence::not_covered);
    }
  }
  for (const auto& region : regions_of_line(Line{})) EXPECT_EQ(region.presence, Presence::not_covered);
}

TEST(Regions, LeaveUnresolvedAndUnfinishedPointsOutOfTheShare) {
  auto pieces = four_regions();
  pieces[1].motion = {255, 254, 3, 0, 255};
  EXPECT_NEAR(regions_of(pieces)[1].aperiodic_share, 2.0 / 3.0, 0.01);
}

TEST(Regions, AreFoundOnACoarseGrid) {
  const auto regions =
      regions_of({{0.33, {1}, 1e-4}, {0.55, {255}, 1e-2}, {0.67, {1}, 5e-3}, {0.95, {255}, 2e-2}}, 31);
  expect_extent(regions[0], 0.05, 0.32);
  expect_extent(regions[1], 0.35, 0.53);
  expect_extent(regions[2], 0.56, 0.65);
  expect_extent(regions[3], 0.68, 0.95);
}

TEST(Stretches, NeedHalfOfTheWindowToBeAperiodic) {
  const auto stretches_of = [](std::vector<std::uint8_t> motion) {
    const auto points = classified_points(line_of(0.3, 201, {{0.5, std::move(motion), 1e-3}}), kThreeBlades);
    return aperiodic_stretches(points, kShareWindow, kAperiodicMajority).size();
  };
  EXPECT_EQ(stretches_of({255, 1, 255}), 1U);
  EXPECT_EQ(stretches_of({255, 1, 1}), 0U);
  EXPECT_EQ(stretches_of({255}), 1U);
  EXPECT_EQ(stretches_of({1}), 0U);
}

TEST(Stretches, AreNotMadeByOnePointBetweenGaps) {
  const auto nothing = motion_class::kNone;
  const auto line = line_of(
      0.3, 201, {{0.38, {nothing}, kNotANumber}, {0.381, {255}, 1e-2}, {0.5, {nothing}, kNotANumber}});
  EXPECT_TRUE(
      aperiodic_stretches(classified_points(line, kThreeBlades), kShareWindow, kAperiodicMajority).empty());
}

TEST(PeriodDoublings, AreFoundWhereAPeriodBecomesTwiceItself) {
  const std::vector<double> speed{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8};
  const std::vector<std::uint8_t> cascade{1, 1, 2, 2, 254, 4, 4, 255};
  const auto doublings = period_doublings(speed, cascade);
  ASSERT_EQ(doublings.size(), 2U);
  EXPECT_DOUBLE_EQ(doublings[0].speed_ratio, 0.25);
  EXPECT_EQ(doublings[0].from_period, 1);
  EXPECT_DOUBLE_EQ(doublings[1].speed_ratio, 0.5);
  EXPECT_EQ(doublings[1].from_period, 2);
}

TEST(PeriodDoublings, NeedOnePointOnlyWhereTheCascadeGoesOn) {
  const std::vector<double> speed{0.1, 0.2, 0.3, 0.4, 0.5};
  for (const std::vector<std::uint8_t>& motion :
       {std::vector<std::uint8_t>{1, 1, 1, 2, 255}, {1, 1, 1, 2, 254}, {1, 1, 1, 2, 4}}) {
    ASSERT_EQ(period_doublings(speed, motion).size(), 1U);
    EXPECT_DOUBLE_EQ(period_doublings(speed, motion)[0].speed_ratio, 0.35);
  }
  for (const std::vector<std::uint8_t>& motion :
       {std::vector<std::uint8_t>{1, 1, 1, 2, 1}, {1, 1, 1, 1, 2}}) {
    EXPECT_TRUE(period_doublings(speed, motion).empty());
  }
}

TEST(PeriodDoublings, AreNotSeenInSinglePointsJumpsOrHalvings) {
  const std::vector<double> speed{0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  for (const std::vector<std::uint8_t>& motion : {std::vector<std::uint8_t>{1, 1, 2, 1, 1, 1},
                                                  {1, 1, 3, 3, 3, 3},
                                                  {2, 2, 2, 1, 1, 1},
                                                  {1, 1, 255, 2, 2, 2},
                                                  {255, 255, 254, 254, 0, 0}}) {
    EXPECT_TRUE(period_doublings(speed, motion).empty());
  }
}

}  // namespace
}  // namespace rubatlas::analysis

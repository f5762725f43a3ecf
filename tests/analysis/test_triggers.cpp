// Triggers of lines whose steps are prescribed.
#include "analysis/rules/triggers.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "synthetic_line.hpp"

namespace rubatlas::analysis {
namespace {

constexpr double kFloor = 1e-8;

/// 901 speeds, 0.001 apart, with a displacement given as a function of Ω.
template <typename Displacement>
Line line_with(Displacement displacement, std::size_t count = 901) {
  Line line = line_of(0.05, count, {{0.95, {1}, 0.0}});
  for (std::size_t i = 0; i < line.size(); ++i) line.max_displacement[i] = displacement(line.speed_ratio[i]);
  return line;
}

TEST(Triggers, AreFoundAtStepsAndCarryTheirSize) {
  const auto line = line_with([](double speed) {
    return speed < 0.3405 ? 1e-4 : speed < 0.6605 ? 1e-2 : 2.5e-2;
  });
  const auto triggers = find_triggers(line, kThreeBlades, kFloor);
  ASSERT_EQ(triggers[0].presence, Presence::present);
  EXPECT_NEAR(triggers[0].speed_ratio, 0.3405, 1e-9);
  EXPECT_NEAR(triggers[0].ratio(), 100.0, 1e-9);
  EXPECT_NEAR(triggers[0].rise(), 9.9e-3, 1e-12);
  ASSERT_EQ(triggers[1].presence, Presence::present);
  EXPECT_NEAR(triggers[1].speed_ratio, 0.6605, 1e-9);
  EXPECT_NEAR(triggers[1].ratio(), 2.5, 1e-9);
}

TEST(Triggers, AreAbsentInTheForcedResponseOfALinearRotor) {
  const auto line = line_with([](double speed) { return 1e-3 * speed * speed / (1.0 - speed * speed); });
  for (const auto& trigger : find_triggers(line, kThreeBlades, kFloor)) {
    EXPECT_EQ(trigger.presence, Presence::absent);
    EXPECT_TRUE(std::isnan(trigger.speed_ratio));
  }
}

TEST(Triggers, AreAbsentWhereTheDisplacementDrops) {
  const auto line = line_with([](double speed) { return speed < 0.34 ? 1e-2 : speed < 0.66 ? 1e-3 : 1e-4; });
  for (const auto& trigger : find_triggers(line, kThreeBlades, kFloor)) {
    EXPECT_EQ(trigger.presence, Presence::absent);
  }
}

TEST(Triggers, AreAbsentWhereTheStepIsFarFromAThird) {
  const auto line = line_with([](double speed) { return speed < 0.5 ? 1e-4 : 1e-2; });
  const auto triggers = find_triggers(line, kThreeBlades, kFloor);
  EXPECT_EQ(triggers[0].presence, Presence::absent);
  EXPECT_EQ(triggers[1].presence, Presence::absent);
}

TEST(Triggers, AreNotMovedByOnePointThatStandsOut) {
  auto line = line_with([](double speed) { return speed < 0.3405 ? 1e-4 : 1e-2; });
  line.max_displacement[260] = 5e-2;  // Ω = 0.31
  EXPECT_NEAR(find_triggers(line, kThreeBlades, kFloor)[0].speed_ratio, 0.3405, 1e-9);
  const auto flat = line_with([](double speed) { return std::abs(speed - 0.31) < 1e-6 ? 1e-2 : 1e-3; });
  EXPECT_EQ(find_triggers(flat, kThreeBlades, kFloor)[0].presence, Presence::absent);
}

TEST(Triggers, ScaleWithTheNumberOfBlades) {
  const auto line = line_with([](double speed) {
    return speed < 0.1705 ? 1e-4 : speed < 0.3305 ? 1e-3 : 1e-2;
  });
  const auto triggers = find_triggers(line, SpeedScale(6), kFloor);
  EXPECT_NEAR(triggers[0].speed_ratio, 0.1705, 1e-9);
  EXPECT_NEAR(triggers[1].speed_ratio, 0.3305, 1e-9);
}

TEST(Triggers, AreFoundOnACoarseGrid) {
  const auto line =
      line_with([](double speed) { return speed < 0.34   ? 1e-4
                                          : speed < 0.66 ? 1e-2
                                                         : 3e-2; }, 31);
  const auto triggers =
      find_triggers(line, kThreeBlades, kFloor);  // speeds 0.03 apart: 0.32, 0.35; 0.65, 0.68
  EXPECT_NEAR(triggers[0].speed_ratio, 0.335, 1e-9);
  EXPECT_NEAR(triggers[1].speed_ratio, 0.665, 1e-9);
}

TEST(Triggers, AreNotCoveredWhereTheLineEndsBeforeThem) {
  const auto line = line_of(0.05, 200, {{0.25, {1}, 1e-4}});
  for (const auto& trigger : find_triggers(line, kThreeBlades, kFloor)) {
    EXPECT_EQ(trigger.presence, Presence::not_covered);
  }
}

TEST(Triggers, AreNotCoveredByPointsTooFarApartToSeeThem) {
  const auto step = [](double speed) { return speed < 0.34 ? 1e-4 : speed < 0.66 ? 1e-2 : 3e-2; };
  for (const std::size_t count : {2, 3, 6, 8, 10, 13}) {
    for (const auto& trigger : find_triggers(line_with(step, count), kThreeBlades, kFloor))
      EXPECT_EQ(trigger.presence, Presence::not_covered) << count << " speeds";
  }
}

TEST(Triggers, AreNotCalledAbsentWhereAGapMayHideThem) {
  auto line = line_with([](double speed) { return speed < 0.5 ? 1e-3 : 1e-2; });
  for (std::size_t i = 280; i < 310; ++i) {  // Ω from 0.33 to 0.36
    line.max_displacement[i] = kNotANumber;
    line.motion[i] = motion_class::kNone;
  }
  const auto triggers = find_triggers(line, kThreeBlades, kFloor);
  EXPECT_EQ(triggers[0].presence, Presence::not_covered);
  EXPECT_EQ(triggers[1].presence, Presence::absent);
  // Nor is a step across the gap a trigger: nobody knows where in the gap it is.
  for (std::size_t i = 310; i < 450; ++i) line.max_displacement[i] = 1e-1;
  EXPECT_EQ(find_triggers(line, kThreeBlades, kFloor)[0].presence, Presence::not_covered);
}

TEST(Triggers, AreNotCoveredWhereNoDisplacementIsKnown) {
  const auto line = line_with([](double) { return kNotANumber; });
  EXPECT_EQ(find_triggers(line, kThreeBlades, kFloor)[0].presence, Presence::not_covered);
  auto without = line;
  without.max_displacement.clear();
  EXPECT_EQ(find_triggers(without, kThreeBlades, kFloor)[0].presence, Presence::not_covered);
}

TEST(Triggers, SkipPointsThatAreNotDone) {
  auto line = line_with([](double speed) { return speed < 0.3405 ? 1e-4 : 1e-2; });
  for (std::size_t i = 200; i < 400; i += 3) line.max_displacement[i] = kNotANumber;
  EXPECT_NEAR(find_triggers(line, kThreeBlades, kFloor)[0].speed_ratio, 0.3405, 1.01e-3);
}

TEST(Triggers, TakeAShaftAtRestForTheFloor) {
  const auto line = line_with([](double speed) { return speed < 0.3405 ? 0.0 : 1e-4; });
  const auto trigger = find_triggers(line, kThreeBlades, kFloor)[0];
  EXPECT_NEAR(trigger.speed_ratio, 0.3405, 1e-9);
  EXPECT_NEAR(trigger.ratio(), 1e4, 1e-6);
  // Both below the floor: no trigger, whatever their ratio.
  const auto tiny = line_with([](double speed) { return speed < 0.3405 ? 1e-15 : 1e-9; });
  EXPECT_EQ(find_triggers(tiny, kThreeBlades, kFloor)[0].presence, Presence::absent);
}

}  // namespace
}  // namespace rubatlas::analysis

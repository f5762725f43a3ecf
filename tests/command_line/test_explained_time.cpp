// The time that `explain` estimates, and that it takes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "explained.hpp"
#include "mpi/commands/estimate.hpp"
#include "mpi/commands/explain.hpp"
#include "settings/reader.hpp"

namespace rubatlas::mpi {
namespace {

TEST(ExplainedTime, EstimatesTheTimeFromPointsOfTheScene) {
  const std::string text = explained(kSmallScene);
  EXPECT_TRUE(holds(text, "\nTime (an estimate"));
  // How many points there is time for, and whether one ends, is a matter of the clock.
  const std::string from = line_of(text, "from");
  EXPECT_TRUE(holds(from, " tried from `initial`: ") ||
              holds(from, "none of which came to its end in the time"))
      << text;
  EXPECT_TRUE(holds(line_of(text, "they had"), "touch-downs a revolution")) << text;
}

settings::Scene small_scene() {
  return settings::parse_scene(kSmallScene);
}

TEST(ExplainedTime, TriesAllPointsOfASmallGridWhereTheClockLeavesTimeForThem) {
  const auto cost = estimate_cost(small_scene(), 1.0, [] { return 0.0; });
  EXPECT_EQ(cost.trials, 6U);
  EXPECT_EQ(cost.given_up, 0U);
  EXPECT_GT(cost.seconds_per_point, 0.0);
  EXPECT_LE(cost.fastest, cost.slowest);
}

TEST(ExplainedTime, BeginsNoFurtherPointWhenTheTimeIsUp) {
  // The clock jumps beyond the budget, but not to the moment at which points are given up.
  int looks = 0;
  const auto cost = estimate_cost(small_scene(), 1.0, [&] { return looks++ == 0 ? 0.0 : 1.1; });
  EXPECT_EQ(cost.trials, 1U) << "the one that was begun before";
  EXPECT_EQ(cost.given_up, 0U);
}

TEST(ExplainedTime, GivesPointsUpThatHaveNotEndedWhenTheTimeIsOver) {
  int looks = 0;
  const auto cost = estimate_cost(small_scene(), 1.0, [&] { return looks++ < 12 ? 0.0 : 9.0; });
  EXPECT_EQ(cost.trials, 0U);
  EXPECT_EQ(cost.given_up, 1U);
  EXPECT_GT(cost.revolutions, 0.0);
  EXPECT_GT(cost.seconds_per_point, 0.0) << "from the revolutions that were completed";
}

TEST(ExplainedTime, MeasuresPointsAndEffectsTogetherNoLongerThanItMay) {
  // A look at the clock takes a hundredth of the time; motions that would take hours look at it within.
  const auto scene =
      settings::parse_scene(R"({"grid": {"speed_ratio": {"from": 0.0001, "to": 0.001, "count": 1000},
    "friction": {"from": 0.1, "to": 0.9, "count": 1000},
    "/gravity/acceleration": {"from": 0.1, "to": 0.9, "count": 1000}},
    "side_load": {"force": 0.1}, "support": {"stiffness_xy": 1}, "load_direction": {},
    "speed_ripple": {"amplitude": 0.01},
    "unequal_blades": {"length_spread": 1e-5}, "wear": {"rate": 1e-9}, "blades": {"count": 50},
    "protocol": {"transient_revolutions": 1000000}})");
  int looks = 0;
  const std::string text = explain(scene, 1.0, [&] { return 0.01 * looks++; });
  EXPECT_TRUE(holds(text, "not measured: its motions take too long for that here")) << text;
  EXPECT_GE(looks, 100) << "the time was used";
  EXPECT_LT(looks, 150) << "points that are given up, and effects that are not begun, look once more each";
}

/// Explains with little processor time, however large the scene is, and returns the text.
std::string explained_cheaply(const std::string& scene) {
  // `explain` measures for 2 s; what else it does takes longer on a slow machine.
  constexpr int kMostSeconds = 9;
  const Workplace place;
  static_cast<void>(place.write("s.json", scene));
  const auto ending = place.rubatlas_within(kMostSeconds, "explain s.json");
  EXPECT_EQ(ending.code, 0) << ending.messages;
  return ending.output;
}

TEST(ExplainedTime, ABillionPointsOnAMillionLinesTakeLittleProcessorTime) {
  const std::string text =
      explained_cheaply(R"({"grid": {"speed_ratio": {"from": 0.1, "to": 0.9, "count": 1000},
    "/side_load/force": {"from": 0, "to": 1, "count": 1000}, "friction": {"from": 0, "to": 1, "count": 1000}}})");
  EXPECT_TRUE(holds(line_of(text, "side_load"), "; no term on 1000 of 1000000 lines"))
      << line_of(text, "side_load");
  EXPECT_TRUE(holds(line_of(text, "together"), "1000000000 points × ")) << text;
}

TEST(ExplainedTime, APointOfHoursTakesLittleProcessorTime) {
  const std::string text =
      explained_cheaply(R"({"grid": {"speed_ratio": 0.0002}, "accuracy": {"method": "fixed",
    "step": 1e-6}, "protocol": {"transient_revolutions": 100000000}})");
  EXPECT_TRUE(holds(text, "\nTime")) << text;
}

TEST(ExplainedTime, SaysWhatOfALargeSceneIsTooLarge) {
  const std::string text =
      explained_cheaply(R"({"grid": {"speed_ratio": {"from": 0.1, "to": 0.9, "count": 1000000}},
    "protocol": {"transient_revolutions": 0, "sampled_revolutions": 1000000, "samples_per_revolution": 2000},
    "spectrum": {"max_order": 1000}, "observables": ["spectrum"]})");
  EXPECT_TRUE(holds(line_of(text, "together"), "8 PB  1000000 points × 8 GB a row"))
      << line_of(text, "together");
  EXPECT_TRUE(holds(line_of(text, "memory"), "for records and rows of the lines")) << line_of(text, "memory");
}

TEST(ExplainedTime, SaysHowManyRanksHaveWork) {
  const std::string protocol = R"("protocol": {"transient_revolutions": 2, "sampled_revolutions": 2})";
  const auto time_of = [&](const std::string& rest) {
    return line_of(explained("{" + rest + ", " + protocol + "}"), "on one rank");
  };
  EXPECT_TRUE(
      holds(time_of(R"("grid": {"speed_ratio": [0.3, 0.5]})"), "; more ranks do not help with one line"));
  EXPECT_TRUE(holds(time_of(R"("grid": {"speed_ratio": [0.3, 0.5], "damping_ratio": [0.1, 0.2, 0.3]})"),
                    ", divided by the number of ranks, of which 3 at most have work"));
  EXPECT_TRUE(holds(time_of(R"("grid": {"speed_ratio": [0.3, 0.5]}, "sweep": "independent")"),
                    ", divided by the number of ranks, of which 2 at most have work"));
}

TEST(ExplainedTime, SaysWhatPiecesCostAndWhatSeveralRanksMakeOfThem) {
  const auto line = [](int count, const std::string& rest) {
    return explained(fmt::format(R"({{"grid": {{"speed_ratio": {{"from": 0.1, "to": 0.2, "count": {}}}}},
      "protocol": {{"transient_revolutions": 2, "sampled_revolutions": 2}}{}}})",
                                 count, rest));
  };
  for (const std::string& whole : {line(256, ""), line(300, R"(, "pieces": null)")}) {
    EXPECT_TRUE(holds(line_of(whole, "on one rank"), "; more ranks do not help with one line"));
    EXPECT_FALSE(holds(whole, "on more ranks"));
    EXPECT_FALSE(holds(whole, "undecided"));
  }

  // 300 points, and one at each of six seams.
  const std::string cut = line(300, "");
  EXPECT_TRUE(
      holds(line_of(cut, "pieces"), "7  a line, of up to 48 points, begun from `initial`, and replaced"));
  EXPECT_TRUE(holds(line_of(cut, "pieces"), ": 2.0 % more points to compute, at least"));
  EXPECT_TRUE(holds(line_of(cut, "undecided"), "`/seam` 3"));
  EXPECT_TRUE(holds(line_of(cut, "on one rank"), "of which 7 at most have work"));
  EXPECT_TRUE(holds(line_of(cut, "on more ranks"), "and no less"));

  const std::string led_into = line(128, R"(, "pieces": {"points": 64, "lead_in": 8})");
  EXPECT_TRUE(holds(line_of(led_into, "pieces"), "begun from `initial` 8 points ahead"));
  EXPECT_TRUE(holds(line_of(led_into, "pieces"), ": 7.0 % more points to compute, at least"));
}

}  // namespace
}  // namespace rubatlas::mpi

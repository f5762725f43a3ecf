// What happens along a parameter, in words.
#include "analysis/rules/sensitivity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/rules/course.hpp"
#include "synthetic_line.hpp"

namespace rubatlas::analysis {
namespace {

std::string course_of(std::vector<double> values, Noticeable noticeable = {0.0, 0.1}) {
  std::vector<CoursePoint> points;
  for (std::size_t i = 0; i < values.size(); ++i)
    points.push_back({values[i], std::string(1, static_cast<char>('a' + i))});
  return describe_course(points, {"it", "grows", "falls"}, noticeable,
                         [](const CoursePoint& p) { return std::to_string(std::lround(p.value)); });
}

TEST(Course, SaysWhatGrowsAndWhatFalls) {
  EXPECT_EQ(course_of({10, 15, 20}), "it grows from 10 at a to 20 at c");
  EXPECT_EQ(course_of({20, 15, 10}), "it falls from 20 at a to 10 at c");
}

TEST(Course, NamesAnExtremeInBetween) {
  EXPECT_EQ(course_of({10, 20, 12}), "it grows from 10 at a to 20 at b, then falls to 12 at c");
  EXPECT_EQ(course_of({20, 10, 18}), "it falls from 20 at a to 10 at b, then grows to 18 at c");
}

TEST(Course, IsSilentAboutWhatIsNotNoticeable) {
  EXPECT_EQ(course_of({100, 105, 109}), "");
  EXPECT_EQ(course_of({100, 109, 100}), "");
  EXPECT_EQ(course_of({10, 20}, {11.0, 0.1}), "");
  EXPECT_EQ(course_of({10, 20}, {9.0, 0.1}), "it grows from 10 at a to 20 at b");
  EXPECT_EQ(course_of({7}), "");
  EXPECT_EQ(course_of({}), "");
  EXPECT_EQ(course_of({0, 0, 0}, {0.0, 0.0}), "");
}

plan::Axis axis(const std::string& name, const std::string& units, std::vector<double> values) {
  return {name, std::move(values), units, name};
}

/// Chaos of region 2 up to `end_of_chaos`, everything else as in the paper's picture.
LineSummary summary_with(double end_of_chaos, std::vector<double> parameters) {
  auto pieces = four_regions();
  pieces[1] = {end_of_chaos, {255}, 1e-2};
  return summarise(line_of(0.05, 901, pieces), std::move(parameters), SpeedScale(3), 1e-8);
}

std::string text_of(const Sensitivity& sensitivity, const std::string& subject) {
  for (const auto& effect : sensitivity.effects) {
    if (effect.subject == subject) return effect.text;
  }
  return "no such subject";
}

TEST(Parameter, IsWrittenWithSymbolAndUnit) {
  const std::vector<plan::Axis> axes{axis("direction", "1", {0, 1}), axis("thickness", "m", {0.0005, 0.001}),
                                     axis("damping_ratio", "1", {0.01, 0.1, 0.2}),
                                     axis("speed_ratio", "1", {0.1})};
  const auto parameters = parameters_of(axes);
  ASSERT_EQ(parameters.size(), 3U);
  EXPECT_EQ(parameters[0].text(1.0), "direction = down");
  EXPECT_EQ(parameters[1].text(0.0005), "h = 0.5 mm");
  EXPECT_EQ(parameters[2].text(0.01), "ζ = 0.01");
  const auto& values = parameters[2].values;
  EXPECT_EQ(parameters[2].where(values, values), "at every ζ");
  EXPECT_EQ(parameters[2].where(std::vector{0.01, 0.1}, values), "at ζ ≤ 0.1");
  EXPECT_EQ(parameters[2].where(std::vector{0.1, 0.2}, values), "at ζ ≥ 0.1");
  EXPECT_EQ(parameters[2].where(std::vector{0.01, 0.2}, values), "at ζ = 0.01, 0.2");
}

TEST(Sensitivity, TellsHowRegionsWidenAndShorten) {
  const std::vector<plan::Axis> axes{axis("friction", "1", {0.1}), axis("damping_ratio", "1", {0.05, 0.1}),
                                     axis("speed_ratio", "1", {0.1})};
  const std::vector<LineSummary> lines{summary_with(0.60, {0.1, 0.05}), summary_with(0.50, {0.1, 0.1})};
  const auto found = sensitivities(parameters_of(axes), lines, SpeedScale(3));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].parameter, 1U);
  EXPECT_EQ(found[0].fixed, "μ = 0.1");
  EXPECT_EQ(found[0].lines, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(text_of(found[0], "region 2"),
            "shortens from 0.266 (0.334-0.600) at ζ = 0.05 to 0.166 (0.334-0.500) at ζ = 0.1");
  EXPECT_EQ(text_of(found[0], "region 3"),
            "widens from 0.065 (0.601-0.666) at ζ = 0.05 to 0.165 (0.501-0.666) at ζ = 0.1");
  EXPECT_EQ(text_of(found[0], "region 1"), "known as (0.050)-0.333 at every ζ");
  EXPECT_EQ(text_of(found[0], "trigger 1"), "stays at 0.333");
}

TEST(Sensitivity, TellsWhereRegionsDisappearAndMerge) {
  const std::vector<plan::Axis> axes{axis("unbalance", "kg m", {0.0, 1e-5, 1e-4}),
                                     axis("speed_ratio", "1", {0.1})};
  const Line through = line_of(0.05, 901, {{1.0 / 3.0, {1}, 1e-4}, {0.95, {255}, 1e-2}});
  const std::vector<LineSummary> lines{summary_with(0.60, {0.0}),
                                       summarise(through, {1e-5}, SpeedScale(3), 1e-8),
                                       summarise(through, {1e-4}, SpeedScale(3), 1e-8)};
  const auto found = sensitivities(parameters_of(axes), lines, SpeedScale(3));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(text_of(found[0], "region 3"), "absent at me ≥ 1e-05 kg m; 0.601-0.666 at me = 0 kg m");
  EXPECT_EQ(text_of(found[0], "region 4"),
            "merged with region 2 at me ≥ 1e-05 kg m; known as 0.667-(0.950) at me = 0 kg m");
  EXPECT_EQ(text_of(found[0], "trigger 2"), "absent at me ≥ 1e-05 kg m; 0.667 at me = 0 kg m");
}

TEST(Sensitivity, HasOneEntryPerCombinationOfTheOthersAndNoneForTheDirection) {
  const std::vector<plan::Axis> axes{axis("direction", "1", {0, 1}), axis("friction", "1", {0.1, 0.2}),
                                     axis("damping_ratio", "1", {0.05, 0.1}),
                                     axis("speed_ratio", "1", {0.1})};
  std::vector<LineSummary> lines;
  for (const double direction : {0.0, 1.0}) {
    for (const double friction : {0.1, 0.2}) {
      for (const double damping : {0.05, 0.1})
        lines.push_back(summary_with(0.5, {direction, friction, damping}));
    }
  }
  const auto found = sensitivities(parameters_of(axes), lines, SpeedScale(3));
  ASSERT_EQ(found.size(), 8U);  // friction and damping, each at four combinations of the others
  EXPECT_EQ(found[0].fixed, "direction = up, ζ = 0.05");
  EXPECT_EQ(found[0].lines, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(found[7].fixed, "direction = down, μ = 0.2");
  EXPECT_EQ(found[7].lines, (std::vector<std::size_t>{6, 7}));
}

TEST(Sensitivity, FollowsEachParameterAlongLinesThatShareAllOthers) {
  const std::vector<plan::Axis> axes{axis("thickness", "m", {0.001, 0.002}), axis("unbalance", "kg m", {0.0}),
                                     axis("friction", "1", {0.1, 0.2, 0.3}),
                                     axis("damping_ratio", "1", {0.05, 0.1, 0.15, 0.2}),
                                     axis("speed_ratio", "1", {0.1})};
  std::vector<LineSummary> lines;
  for (const double thickness : axes[0].values) {
    for (const double friction : axes[2].values) {
      for (const double damping : axes[3].values) {
        lines.emplace_back();
        lines.back().parameters = {thickness, 0.0, friction, damping};
      }
    }
  }
  const auto parameters = parameters_of(axes);
  const auto found = sensitivities(parameters, lines, SpeedScale(3));
  ASSERT_EQ(found.size(), 3U * 4U + 2U * 4U + 2U * 3U);
  for (const auto& one : found) {
    const auto& along = parameters[one.parameter].values;
    ASSERT_EQ(one.lines.size(), along.size());
    for (std::size_t i = 0; i < along.size(); ++i) {
      auto expected = lines[one.lines.front()].parameters;
      expected[one.parameter] = along[i];
      EXPECT_EQ(lines[one.lines[i]].parameters, expected);
    }
  }
}

TEST(Sensitivity, ShowsARegionThatEndsAtAGapAsFarAsItIsKnown) {
  const std::vector<plan::Axis> axes{axis("damping_ratio", "1", {0.05, 0.1}),
                                     axis("speed_ratio", "1", {0.1})};
  auto pieces = four_regions();
  pieces[1] = {0.45, {255}, 1e-2};
  pieces.insert(pieces.begin() + 2, {0.55, {motion_class::kNone}, kNotANumber});
  const std::vector<LineSummary> lines{summarise(line_of(0.05, 901, pieces), {0.05}, SpeedScale(3), 1e-8),
                                       summary_with(0.5, {0.1})};
  const auto found = sensitivities(parameters_of(axes), lines, SpeedScale(3));
  EXPECT_EQ(text_of(found[0], "region 2"), "known as 0.334-(0.450) at ζ = 0.05; 0.334-0.500 at ζ = 0.1");
}

TEST(Sensitivity, ComparesTheKnownEndsOfARegionThatTheGridCutsOff) {
  const std::vector<plan::Axis> axes{axis("damping_ratio", "1", {0.05, 0.1, 0.15}),
                                     axis("speed_ratio", "1", {0.1})};
  std::vector<LineSummary> lines;
  for (const auto& [damping, begins] : {std::pair{0.05, 0.70}, {0.1, 0.75}, {0.15, 0.80}}) {
    auto pieces = four_regions();
    pieces[2].to = begins;
    lines.push_back(summarise(line_of(0.05, 901, pieces), {damping}, SpeedScale(3), 1e-8));
  }
  const auto found = sensitivities(parameters_of(axes), lines, SpeedScale(3));
  EXPECT_EQ(
      text_of(found[0], "region 4"),
      "known as 0.701-(0.950) to 0.801-(0.950) at every ζ; its beginning moves up from 0.701 at ζ = 0.05 "
      "to 0.801 at ζ = 0.15");
}

}  // namespace
}  // namespace rubatlas::analysis

// Which methods with which knobs a study compares.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "mpi/accuracy/accuracy_settings.hpp"
#include "mpi/exit_code.hpp"

namespace rubatlas::mpi {
namespace {

std::vector<atlas::AccuracySetting> settings_of(const AccuracyLadders& ladders) {
  return accuracy_settings(ladders, {});
}

TEST(AccuracySettings, TheReferenceIsHybridAndTenTimesTighterThanTheTightest) {
  const auto settings = settings_of({.methods = {"located"}, .tolerances = {1e-8, 1e-6}});
  ASSERT_EQ(settings.size(), 3U);
  EXPECT_EQ(settings[0].method, "hybrid");
  EXPECT_DOUBLE_EQ(settings[0].tolerance, 1e-9);
  EXPECT_EQ(settings[1].method, "located");
  EXPECT_EQ(settings[1].tolerance, 1e-8);
}

TEST(AccuracySettings, EachMethodIsVariedInTheKnobsThatItReads) {
  const AccuracyLadders ladders{.methods = {"hybrid_54", "paper", "located", "fixed"},
                                .tolerances = {1e-6, 1e-8, 1e-10},
                                .force_increments = {0.5, 0.05},
                                .steps = {1e-2, 1e-3}};
  const auto settings = settings_of(ladders);
  const auto count = [&](const std::string& method) {
    return std::count_if(settings.begin() + 1, settings.end(),
                         [&](const auto& setting) { return setting.method == method; });
  };
  EXPECT_EQ(count("hybrid_54"), 3);
  EXPECT_EQ(count("paper"), 3 * 2) << "every tolerance with every increment";
  EXPECT_EQ(count("located"), 3);
  EXPECT_EQ(count("fixed"), 2);
  for (const auto& setting : settings) {
    const bool fixed = setting.method == "fixed";
    const bool paper = setting.method == "paper";
    EXPECT_EQ(std::isfinite(setting.tolerance), !fixed) << setting.method;
    EXPECT_EQ(std::isfinite(setting.step), fixed) << setting.method;
    EXPECT_EQ(std::isfinite(setting.force_increment), paper) << setting.method;
    EXPECT_EQ(std::isfinite(setting.max_step), paper || setting.method == "located") << setting.method;
  }
}

TEST(AccuracySettings, AllMethodsOfAScenesChoiceAreComparedUnlessSomeAreNamed) {
  std::set<std::string> compared;
  for (const auto& setting : settings_of({})) compared.insert(setting.method);
  EXPECT_EQ(compared, (std::set<std::string>{"hybrid", "collocation", "hybrid_54", "hybrid_32", "paper",
                                             "located", "fixed"}));
}

TEST(AccuracySettings, MethodsThatDoNotTakeTheScenesEffectsAreLeftOutUnlessTheyAreNamed) {
  settings::Scene scene;
  EXPECT_TRUE(methods_left_out(scene).empty());
  scene.gravity.emplace();
  std::set<std::string> compared;
  for (const auto& setting : accuracy_settings({}, scene)) compared.insert(setting.method);
  EXPECT_EQ(compared, (std::set<std::string>{"hybrid", "collocation"}));
  EXPECT_EQ(methods_left_out(scene),
            (std::vector<std::string_view>{"hybrid_54", "hybrid_32", "paper", "located", "fixed"}));
  try {
    static_cast<void>(accuracy_settings({.methods = {"hybrid", "fixed"}}, scene));
    ADD_FAILURE() << "fixed is not refused";
  } catch (const UsageError& refusal) {
    EXPECT_STREQ(refusal.what(),
                 "--methods fixed: /gravity: the method \"fixed\" computes the paper's rotor and its "
                 "unbalance; effects need \"collocation\" or \"hybrid\"");
  }
}

TEST(AccuracySettings, TheTwoKnobsOfThePublishedSchemeAreRefinedTogether) {
  const auto settings = settings_of({.methods = {"paper"}});
  ASSERT_GE(settings.size(), 4U);
  EXPECT_DOUBLE_EQ(settings[0].tolerance, 1e-13) << "the reference follows the other methods' tolerances";
  for (std::size_t i = 2; i < settings.size(); ++i) {
    EXPECT_LE(settings[i].tolerance, settings[i - 1].tolerance);
    EXPECT_LE(settings[i].force_increment, settings[i - 1].force_increment);
  }
}

TEST(AccuracySettings, AreAppliedToTheSceneThatIsRun) {
  settings::Scene scene;
  scene.accuracy.tolerance = 1e-7;
  const auto paper =
      scene_with({.method = "paper", .tolerance = 1e-5, .force_increment = 0.3, .max_step = 0.1}, scene);
  EXPECT_EQ(paper.accuracy.method, settings::Method::paper);
  EXPECT_EQ(paper.accuracy.tolerance, 1e-5);
  EXPECT_EQ(paper.accuracy.force_increment, 0.3);
  EXPECT_EQ(paper.accuracy.max_step, 0.1);
  const auto fixed = scene_with({.method = "fixed", .step = 0.004}, scene);
  EXPECT_EQ(fixed.accuracy.method, settings::Method::fixed);
  EXPECT_EQ(fixed.accuracy.step, 0.004);
  EXPECT_EQ(fixed.accuracy.tolerance, 1e-7) << "the scene's own, by which its sections are judged";
}

TEST(AccuracySettings, KnobsOutsideTheirRangesAreRefused) {
  EXPECT_THROW(static_cast<void>(settings_of({.methods = {"rk4"}})), UsageError);
  EXPECT_THROW(static_cast<void>(settings_of({.tolerances = {0.5}})), UsageError);
  EXPECT_THROW(static_cast<void>(settings_of({.tolerances = {1e-14}})), UsageError);
  EXPECT_THROW(static_cast<void>(settings_of({.force_increments = {0.0}})), UsageError);
  EXPECT_THROW(static_cast<void>(settings_of({.steps = {-1e-3}})), UsageError);
}

TEST(AccuracySettings, WhatIsNamedTwiceOrReadByNoMethodIsRefused) {
  EXPECT_THROW(static_cast<void>(settings_of({.methods = {"hybrid", "fixed", "hybrid"}})), UsageError);
  EXPECT_THROW(static_cast<void>(settings_of({.tolerances = {1e-6, 1e-8, 1e-6}})), UsageError);
  EXPECT_THROW(static_cast<void>(settings_of({.methods = {"hybrid"}, .steps = {1e-3}})), UsageError);
  EXPECT_THROW(static_cast<void>(settings_of({.methods = {"fixed"}, .force_increments = {0.1}})), UsageError);
  EXPECT_NO_THROW(static_cast<void>(settings_of({.force_increments = {0.1}, .steps = {1e-3}})));
}

}  // namespace
}  // namespace rubatlas::mpi

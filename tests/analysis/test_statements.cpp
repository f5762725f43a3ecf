// Verdicts on P1 to P8, on atlases that show what the paper says, and on such that do not.
#include "analysis/paper/statements.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "settings/scene.hpp"
#include "synthetic_line.hpp"

namespace rubatlas::analysis {
namespace {

/// The default rotor's parameters, in the order unbalance, friction, damping ratio.
struct At {
  double unbalance = 0.0;
  double friction = 0.1;
  double damping = 0.1;
};

class Statements : public ::testing::Test {
 protected:
  void add_line(const Line& line, At at = {}) {
    lines_.push_back(summarise(line, {at.unbalance, at.friction, at.damping}, kThreeBlades, 1e-8));
    for (auto& [axis, value] :
         {std::pair{0, at.unbalance}, std::pair{1, at.friction}, std::pair{2, at.damping}}) {
      auto& values = axes_[static_cast<std::size_t>(axis)].values;
      if (std::ranges::find(values, value) == values.end()) values.push_back(value);
    }
  }
  void add(const std::vector<Piece>& pieces, At at = {}) { add_line(line_of(0.05, 901, pieces), at); }

  Statement judge(std::string_view name, bool per_passing = false) {
    parameters_ = parameters_of(axes_);
    for (auto& statement : judge_statements(scene_, parameters_, lines_, per_passing)) {
      if (statement.name == name) return statement;
    }
    return {"none", {}};
  }
  Verdict verdict(std::string_view name, bool per_passing = false) {
    return judge(name, per_passing).verdict();
  }

  settings::Scene scene_;

 private:
  std::vector<plan::Axis> axes_{{"unbalance", {}, "kg m", ""},
                                {"friction", {}, "1", ""},
                                {"damping_ratio", {}, "1", ""},
                                {"speed_ratio", {0.1}, "1", ""}};
  std::vector<Parameter> parameters_;
  std::vector<LineSummary> lines_;
};

/// The paper's picture with a doubling right below region 4.
std::vector<Piece> paper() {
  auto pieces = four_regions();
  pieces[2].to = 0.66;
  pieces.insert(pieces.begin() + 3, {0.67, {2}, 5e-3});
  return pieces;
}

std::vector<Piece> small_and_periodic() {
  return {{0.95, {1}, 1e-4}};
}

/// The paper's picture with other ends of regions 2 and 3, and another motion in region 1.
std::vector<Piece> paper_with(double end_of_2, double end_of_3, std::vector<std::uint8_t> region_1 = {1}) {
  auto pieces = paper();
  pieces[0].motion = std::move(region_1);
  pieces[1].to = end_of_2;
  pieces[2].to = end_of_3 - 0.01;
  pieces[3].to = end_of_3;
  return pieces;
}

TEST_F(Statements, OneToFourAgreeWithThePapersPicture) {
  add(paper());
  for (const auto* name : {"P1", "P2", "P3", "P4"}) EXPECT_EQ(verdict(name), Verdict::agrees) << name;
}

TEST_F(Statements, OneToFourDisagreeWhereNothingHappens) {
  add(small_and_periodic());
  for (const auto* name : {"P1", "P2", "P4"}) EXPECT_EQ(verdict(name), Verdict::disagrees) << name;
}

TEST_F(Statements, OneHoldsPartlyWhenRegionOneIsChaotic) {
  auto pieces = paper();
  pieces[0].motion = {1, 1, 255};
  add(pieces);
  EXPECT_EQ(verdict("P1"), Verdict::partly);
}

TEST_F(Statements, OneHoldsPartlyWhenTheDisplacementIsLargeFromTheStart) {
  auto pieces = paper();
  pieces[0].displacement = 5e-3;
  add(pieces);
  const auto statement = judge("P1");
  EXPECT_EQ(statement.verdict(), Verdict::partly);
  EXPECT_EQ(statement.findings.back().holds, false);
}

TEST_F(Statements, TwoHoldsPartlyWithoutWindowsOrWhenChaosBeginsLate) {
  auto pieces = paper();
  pieces[1].motion = {255};
  add(pieces);
  EXPECT_EQ(verdict("P2"), Verdict::partly);
}

TEST_F(Statements, ThreeDisagreesWhenChaosGoesThrough) {
  add({{1.0 / 3.0, {1}, 1e-4}, {0.95, {255}, 1e-2}});
  EXPECT_EQ(verdict("P3"), Verdict::disagrees);
}

TEST_F(Statements, FourIsJudgedOnTheMapOverABladePassingWhereItIsThere) {
  auto pieces = paper();
  pieces[3].motion = {3};  // per revolution there is no doubling
  auto line = line_of(0.05, 901, pieces);
  line.motion_per_passing = line_of(0.05, 901, paper()).motion;
  add_line(line);
  EXPECT_EQ(verdict("P4", true), Verdict::agrees);
}

TEST_F(Statements, FourHoldsPartlyWithoutADoubling) {
  add(four_regions());
  const auto statement = judge("P4");
  EXPECT_EQ(statement.verdict(), Verdict::partly);
  EXPECT_NE(statement.findings.back().evidence.find("no period doubling"), std::string::npos);
}

TEST_F(Statements, AreLeftOutForARotorThatIsNotThePapers) {
  EXPECT_EQ(why_none_applies(scene_), "");
  EXPECT_EQ(why_none_applies(test_rig().scene), "");
  scene_.rotor.misalignment = 0.02;
  add(paper());
  add(paper(), {.damping = 0.05});
  for (const auto* name : {"P1", "P5", "P9", "P12", "P16"}) EXPECT_EQ(judge(name).name, "none") << name;
  EXPECT_EQ(why_none_applies(scene_),
            "this is not the paper's default rotor: /rotor/misalignment is 0.02, not 0.01001; nor is it the "
            "paper's test rig");
}

TEST_F(Statements, OfTheTestRigAreNotCoveredForTheDefaultRotor) {
  add(paper());
  EXPECT_EQ(verdict("P10"), Verdict::not_covered);
  EXPECT_TRUE(judge("P10").findings[0].evidence.starts_with("this is not the paper's test rig: "));
}

TEST_F(Statements, OneToFourAreNotCoveredWithoutTheDefaultLine) {
  add(paper(), {.damping = 0.05});
  add(paper(), {.damping = 0.2});
  for (const auto* name : {"P1", "P2", "P3", "P4"}) EXPECT_EQ(verdict(name), Verdict::not_covered) << name;
}

TEST_F(Statements, OneToFourAreNotCoveredOnALineThatIsPending) {
  add({{0.95, {motion_class::kNone}, kNotANumber}});
  for (const auto* name : {"P1", "P2", "P3", "P4"}) EXPECT_EQ(verdict(name), Verdict::not_covered) << name;
}

TEST_F(Statements, FiveToEightAreNotCoveredByASingleLine) {
  add(paper());
  for (const auto* name : {"P5", "P6", "P7", "P8"}) EXPECT_EQ(verdict(name), Verdict::not_covered) << name;
}

TEST_F(Statements, FiveAgreesWhenLowDampingWidensTwoShortensThreeAndStirsOne) {
  add(paper_with(0.60, 0.67, {1, 1, 1, 255}), {.damping = 0.05});
  add(paper_with(0.50, 0.67));
  EXPECT_EQ(verdict("P5"), Verdict::agrees);
}

TEST_F(Statements, FiveDisagreesWhenLowDampingDoesTheOppositeWithoutRegionTwo) {
  add({{1.0 / 3.0, {1}, 1e-4}, {0.67, {1}, 5e-3}, {0.95, {255}, 2e-2}}, {.damping = 0.05});
  add(paper_with(0.50, 0.67));
  EXPECT_EQ(verdict("P5"), Verdict::disagrees);
}

TEST_F(Statements, SixAgreesWhenHighDampingEndsTheChaos) {
  add(paper());
  add({{1.0 / 3.0, {1}, 1e-4}, {0.95, {1}, 1e-3}}, {.damping = 0.3});
  EXPECT_EQ(verdict("P6"), Verdict::agrees);
}

TEST_F(Statements, SixDisagreesWhenHighDampingChangesNothing) {
  add(paper());
  add(paper(), {.damping = 0.3});
  EXPECT_EQ(verdict("P6"), Verdict::disagrees);
}

TEST_F(Statements, SixIsNotFoundWhereThereWasNoChaosToEnd) {
  add(small_and_periodic());
  add(small_and_periodic(), {.damping = 0.3});
  EXPECT_EQ(verdict("P6"), Verdict::disagrees);
}

TEST_F(Statements, SixIsNotCoveredUpToModerateDamping) {
  add(paper(), {.damping = 0.05});
  add(paper());
  EXPECT_EQ(verdict("P6"), Verdict::not_covered);
}

TEST_F(Statements, SevenAgreesWhenChaosIsInRegionOneForModerateFrictionOnly) {
  add(paper(), {.friction = 0.0});
  add(paper_with(0.55, 0.67, {1, 1, 1, 255}));
  add(paper(), {.friction = 0.5});
  EXPECT_EQ(verdict("P7"), Verdict::agrees);
}

TEST_F(Statements, SevenDisagreesWhenFrictionTurnsThePictureOver) {
  add({{1.0 / 3.0, {1, 1, 1, 255}, 1e-4}, {0.95, {1}, 1e-3}}, {.friction = 0.0});
  add(paper());
  EXPECT_EQ(verdict("P7"), Verdict::disagrees);
}

TEST_F(Statements, EightAgreesWhenUnbalanceMergesTheRegions) {
  add(paper());
  add(paper(), {.unbalance = 1e-5});
  add({{1.0 / 3.0, {1}, 1e-4}, {0.95, {255}, 1e-2}}, {.unbalance = 1e-4});
  EXPECT_EQ(verdict("P8"), Verdict::agrees);
}

TEST_F(Statements, EightDisagreesWhenTheRegionsAreNotThereAndNothingChanges) {
  add(small_and_periodic());
  add(small_and_periodic(), {.unbalance = 1e-5});
  EXPECT_EQ(verdict("P8"), Verdict::disagrees);
}

TEST_F(Statements, EightSaysWhenTheRegionsMergeOnlyBeyondThePapersRange) {
  add(paper());
  add(paper(), {.unbalance = 1e-4});
  add({{1.0 / 3.0, {1}, 1e-4}, {0.95, {255}, 1e-2}}, {.unbalance = 1e-3});
  const auto statement = judge("P8");
  EXPECT_EQ(statement.verdict(), Verdict::partly);
  EXPECT_EQ(statement.findings[3].holds, false);
  EXPECT_EQ(statement.findings[3].evidence, "regions 2, 3 and 4 merged: from me = 0.001 kg m");
}

TEST(Statement, AgreesDisagreesOrHoldsPartlyByItsFindings) {
  const auto verdict_of = [](std::vector<Finding> findings) {
    return Statement{"P", std::move(findings)}.verdict();
  };
  EXPECT_EQ(verdict_of({}), Verdict::not_covered);
  EXPECT_EQ(verdict_of({{std::nullopt, ""}}), Verdict::not_covered);
  EXPECT_EQ(verdict_of({{true, ""}, {std::nullopt, ""}}), Verdict::agrees);
  EXPECT_EQ(verdict_of({{false, ""}, {std::nullopt, ""}}), Verdict::disagrees);
  EXPECT_EQ(verdict_of({{true, ""}, {false, ""}}), Verdict::partly);
}

}  // namespace
}  // namespace rubatlas::analysis

// Verdicts on P9 to P16: other rotors than the default one, and what a rotor leaves open.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "analysis/paper/reference_rotor.hpp"
#include "analysis/paper/statements.hpp"
#include "synthetic_line.hpp"

namespace rubatlas::analysis {
namespace {

/// Lines of an atlas whose axes are named by the test.
class RotorStatements : public ::testing::Test {
 protected:
  void axes(std::vector<std::string> names) {
    for (auto& name : names) axes_.push_back({std::move(name), {}, "1", ""});
    axes_.push_back({"speed_ratio", {0.1}, "1", ""});
  }
  void add(const std::vector<Piece>& pieces, const std::vector<double>& at) {
    lines_.push_back(
        summarise(line_of(first_speed_, 901, pieces), at, SpeedScale(scene_.blades.count), 1e-8));
    for (std::size_t i = 0; i < at.size(); ++i) {
      auto& values = axes_[i].values;
      if (std::ranges::find(values, at[i]) == values.end()) values.push_back(at[i]);
    }
  }
  /// Every statement of that name.
  std::vector<Statement> judged(std::string_view name) {
    parameters_ = parameters_of(axes_);
    auto statements = judge_statements(scene_, parameters_, lines_, false);
    std::erase_if(statements, [&](const Statement& statement) { return statement.name != name; });
    return statements;
  }
  Statement judge(std::string_view name) { return judged(name).at(0); }
  Verdict verdict(std::string_view name) { return judge(name).verdict(); }
  /// What was found of one claim.
  std::optional<bool> holds(std::string_view name, std::string_view claim) {
    const auto statement = judge(name);
    const auto found = std::ranges::find(statement.findings, claim, &Finding::claim);
    if (found == statement.findings.end()) {
      ADD_FAILURE() << name << " has no finding: " << claim;
      return std::nullopt;
    }
    return found->holds;
  }
  void on_the_rig() { scene_ = test_rig().scene; }

  settings::Scene scene_;
  double first_speed_ = 0.05;

 private:
  std::vector<plan::Axis> axes_;
  std::vector<Parameter> parameters_;
  std::vector<LineSummary> lines_;
};

constexpr std::uint8_t kChaos = 255;

/// Small periodic motion, the two rises of the displacement, and no chaos.
std::vector<Piece> rises_without_chaos() {
  return {{1.0 / 3.0, {1}, 1e-5}, {2.0 / 3.0, {1}, 2e-4}, {0.95, {1}, 6e-4}};
}

std::vector<Piece> nothing_happens() {
  return {{0.95, {1}, 1e-5}};
}

/// What the rig showed: P14.
std::vector<Piece> as_measured() {
  return {{0.17, {1}, 1e-5},       {0.192, {kChaos}, 2e-5}, {0.333, {1}, 3e-5},     {0.352, {1}, 1e-4},
          {0.545, {kChaos}, 3e-4}, {0.55, {1}, 4e-4},       {0.58, {kChaos}, 4e-4}, {0.65, {1}, 4e-4},
          {0.80, {kChaos}, 8e-4},  {0.95, {1}, 8e-4}};
}

TEST_F(RotorStatements, FourteenAgreesWithWhatTheRigShowed) {
  on_the_rig();
  axes({"thickness", "friction", "damping_ratio"});
  add(as_measured(), {0.5e-3, 0.1, 0.05});
  const auto statement = judge("P14");
  EXPECT_EQ(statement.findings.size(), 10U);
  for (const auto& finding : statement.findings)
    EXPECT_EQ(finding.holds, true) << finding.claim << finding.evidence;
}

TEST_F(RotorStatements, TheRigIsThatOfTheScenesThatRoundItsNumbersAsThePaperDoes) {
  // 30.23 Hz are 189.9407 rad/s, and 1814 rpm 189.9616 rad/s.
  for (const double frequency : {189.94, 1814.0 * 2.0 * std::numbers::pi / 60.0, 189.9407}) {
    auto scene = test_rig().scene;
    scene.rotor.natural_frequency = frequency;
    scene.blades.youngs_modulus = 2.06e11;
    EXPECT_EQ(test_rig().difference(scene), "") << frequency;
  }
  for (const double frequency : {189.9, 190.0, 10.0}) {
    auto scene = test_rig().scene;
    scene.rotor.natural_frequency = frequency;
    EXPECT_NE(test_rig().difference(scene).find("/rotor/natural_frequency"), std::string::npos) << frequency;
  }
  auto scene = test_rig().scene;
  scene.rotor.misalignment = 0.362e-3;  // a fifth more of the blades in the ring
  EXPECT_NE(test_rig().difference(scene), "");
}

TEST_F(RotorStatements, FourteenSaysWhichBorderLiesElsewhere) {
  on_the_rig();
  axes({"thickness", "friction", "damping_ratio"});
  auto pieces = as_measured();
  pieces[3].to = 0.42;  // chaos begins late
  pieces[8].displacement = 1e-4;
  add(pieces, {0.5e-3, 0.1, 0.05});
  EXPECT_EQ(holds("P14", "region 2 begins at 0.350"), false);
  EXPECT_EQ(holds("P14", "region 2 ends at 0.550"), true);
  EXPECT_EQ(holds("P14", "the displacement grows with Ω"), false);
  EXPECT_EQ(verdict("P14"), Verdict::partly);
}

TEST_F(RotorStatements, TenIsJudgedOnTheMotionsAroundTheFourSpeeds) {
  on_the_rig();
  axes({"thickness", "friction", "damping_ratio"});
  add(as_measured(), {0.5e-3, 0.1, 0.05});
  EXPECT_EQ(verdict("P10"), Verdict::agrees);
}

TEST_F(RotorStatements, TenDisagreesWherePeriodAndChaosAreExchanged) {
  on_the_rig();
  axes({"thickness", "friction", "damping_ratio"});
  add({{0.35, {kChaos}, 1e-5}, {0.55, {1}, 1e-4}, {0.65, {kChaos}, 1e-4}, {0.95, {1}, 1e-4}},
      {0.5e-3, 0.1, 0.05});
  EXPECT_EQ(verdict("P10"), Verdict::disagrees);
}

TEST_F(RotorStatements, TheRigIsJudgedOnceForEveryFrictionAndMass) {
  on_the_rig();
  axes({"rotor_mass", "thickness", "friction", "damping_ratio"});
  for (const double mass : {0.3, 0.5}) {
    for (const double friction : {0.1, 0.2}) {
      add(friction > 0.15 ? as_measured() : nothing_happens(), {mass, 0.5e-3, friction, 0.05});
    }
  }
  const auto statements = judged("P10");
  ASSERT_EQ(statements.size(), 4U);
  EXPECT_EQ(statements[0].setting.text, "m = 0.3, μ = 0.1");
  EXPECT_EQ(statements[0].verdict(), Verdict::partly);
  EXPECT_EQ(statements[1].setting.text, "m = 0.3, μ = 0.2");
  EXPECT_EQ(statements[1].verdict(), Verdict::agrees);
}

TEST_F(RotorStatements, NineAgreesWhenThinBladesLoseTheChaosAndKeepTheRises) {
  on_the_rig();
  axes({"thickness", "friction", "damping_ratio"});
  add(rises_without_chaos(), {0.2e-3, 0.1, 0.05});
  add(rises_without_chaos(), {0.3e-3, 0.1, 0.05});
  add(four_regions(), {0.5e-3, 0.1, 0.05});
  EXPECT_EQ(verdict("P9"), Verdict::agrees);
}

TEST_F(RotorStatements, NineDisagreesWhenThinBladesKeepTheChaosThatThickOnesHaveNot) {
  on_the_rig();
  axes({"thickness", "friction", "damping_ratio"});
  add({{0.35, {1}, 1e-5}, {0.55, {kChaos}, 1e-5}, {0.68, {1}, 1e-5}, {0.95, {kChaos}, 1e-5}},
      {0.2e-3, 0.1, 0.05});
  add(nothing_happens(), {0.5e-3, 0.1, 0.05});
  EXPECT_EQ(verdict("P9"), Verdict::disagrees);
}

TEST_F(RotorStatements, NineDoesNotCountBladesOfExactlyTheLimitAsThin) {
  on_the_rig();
  axes({"thickness", "friction", "damping_ratio"});
  add(four_regions(), {0.4e-3, 0.1, 0.05});
  add(four_regions(), {0.5e-3, 0.1, 0.05});
  EXPECT_EQ(verdict("P9"), Verdict::not_covered);
}

TEST_F(RotorStatements, NineIsNotCoveredByRigidBlades) {
  on_the_rig();
  scene_.contact.law = settings::ContactLaw::elastic_ring;
  axes({"thickness", "friction", "damping_ratio"});
  add(rises_without_chaos(), {0.2e-3, 0.1, 0.05});
  add(four_regions(), {0.5e-3, 0.1, 0.05});
  EXPECT_EQ(verdict("P9"), Verdict::not_covered);
}

/// Lines over misalignment and radius; `changed` says where the picture is another.
template <class Changed>
void add_clearances(const auto& add, Changed changed) {
  for (const double misalignment : {0.36e-3, 0.51e-3}) {
    for (const double radius : {62.5e-3, 62.65e-3}) {
      for (const double thickness : {0.2e-3, 0.5e-3}) {
        add(changed(misalignment, radius, thickness) ? rises_without_chaos() : four_regions(),
            std::vector{misalignment, radius, thickness, 0.1, 0.05});
      }
    }
  }
}

TEST_F(RotorStatements, FifteenAgreesWhenOnlyThinBladesFeelClearanceAndMisalignment) {
  on_the_rig();
  axes({"rotor_misalignment", "ring_radius", "thickness", "friction", "damping_ratio"});
  add_clearances([&](const auto& pieces, const auto& at) { add(pieces, at); },
                 [](double misalignment, double, double thickness) {
                   return thickness < 0.4e-3 && misalignment > 0.4e-3;
                 });
  EXPECT_EQ(verdict("P15"), Verdict::agrees);
}

TEST_F(RotorStatements, FifteenDisagreesWhenOnlyThickBladesFeelThem) {
  on_the_rig();
  axes({"rotor_misalignment", "ring_radius", "thickness", "friction", "damping_ratio"});
  add_clearances([&](const auto& pieces, const auto& at) { add(pieces, at); },
                 [](double misalignment, double, double thickness) {
                   return thickness > 0.4e-3 && misalignment > 0.4e-3;
                 });
  EXPECT_EQ(verdict("P15"), Verdict::disagrees);
}

TEST_F(RotorStatements, FifteenLeavesOutRotorsThatDoNotReachTheRing) {
  on_the_rig();
  axes({"rotor_misalignment", "ring_radius", "thickness", "friction", "damping_ratio"});
  for (const double misalignment : {0.31e-3, 0.36e-3, 0.41e-3}) {  // the clearance is 0.35 mm
    for (const double thickness : {0.2e-3, 0.5e-3}) {
      add(misalignment < 0.35e-3 ? nothing_happens() : four_regions(),
          {misalignment, 62.5e-3, thickness, 0.1, 0.05});
    }
  }
  EXPECT_EQ(holds("P15", "h ≥ 0.4 mm: y0 does not matter"), true);
  EXPECT_EQ(holds("P15", "h < 0.4 mm: y0 matters"), false);
}

TEST_F(RotorStatements, FifteenComparesClearancesAtTheSameReachIntoTheRing) {
  on_the_rig();
  axes({"rotor_misalignment", "ring_radius", "thickness", "friction", "damping_ratio"});
  // The picture is another where the ring has grown, but not the misalignment with it: no reach, no contact.
  add_clearances(
      [&](const auto& pieces, const auto& at) { add(pieces, at); },
      [](double misalignment, double radius, double) { return misalignment < 0.4e-3 && radius > 62.6e-3; });
  EXPECT_EQ(holds("P15", "h ≥ 0.4 mm: δc with y0 = δc + 0.01 mm does not matter"), true);
  EXPECT_EQ(holds("P15", "h ≥ 0.4 mm: y0 does not matter"), true);
}

TEST_F(RotorStatements, TwelveAgreesWhenThePictureScalesWithTheNumberOfBlades) {
  scene_.blades.count = 5;
  first_speed_ = 0.03;
  axes({"friction", "damping_ratio"});
  auto pieces = four_regions();
  for (auto& piece : pieces) piece.to *= 3.0 / 5.0;
  add(pieces, {0.1, 0.1});
  EXPECT_EQ(verdict("P12"), Verdict::agrees);
  EXPECT_EQ(verdict("P1"), Verdict::not_covered);  // which is about three blades
}

TEST_F(RotorStatements, TwelveDisagreesWhenThePictureStaysWhereThreeBladesHaveIt) {
  scene_.blades.count = 10;
  axes({"friction", "damping_ratio"});
  add({{0.95, {1}, 1e-4}}, {0.1, 0.1});
  EXPECT_EQ(holds("P12", "trigger 1 at 1/n"), false);
  EXPECT_EQ(holds("P12", "region 2 is there"), false);
}

TEST_F(RotorStatements, TwelveIsNotCoveredByThreeBlades) {
  axes({"friction", "damping_ratio"});
  add(four_regions(), {0.1, 0.1});
  EXPECT_EQ(verdict("P12"), Verdict::not_covered);
}

TEST_F(RotorStatements, ThirteenAgreesWhenEveryStiffnessShowsThePicture) {
  scene_.contact.law = settings::ContactLaw::elastic_ring;
  axes({"ring_stiffness", "friction", "damping_ratio"});
  for (const double stiffness : {1e3, 1e4}) add(four_regions(), {stiffness, 0.1, 0.1});
  EXPECT_EQ(verdict("P13"), Verdict::agrees);
}

TEST_F(RotorStatements, ThirteenHoldsPartlyWhenASoftRingDoesNot) {
  scene_.contact.law = settings::ContactLaw::elastic_ring;
  axes({"ring_stiffness", "friction", "damping_ratio"});
  add(nothing_happens(), {1e3, 0.1, 0.1});
  add(four_regions(), {1e4, 0.1, 0.1});
  EXPECT_EQ(verdict("P13"), Verdict::partly);
  EXPECT_EQ(holds("P13", "all four regions at some stiffness"), true);
  EXPECT_EQ(holds("P13", "stiffness: trigger 1 at 1/n"), false);
}

TEST_F(RotorStatements, ThirteenDisagreesWhenNoStiffnessDoes) {
  scene_.contact.law = settings::ContactLaw::elastic_ring;
  axes({"ring_stiffness", "friction", "damping_ratio"});
  for (const double stiffness : {1e3, 1e4}) add(nothing_happens(), {stiffness, 0.1, 0.1});
  EXPECT_EQ(verdict("P13"), Verdict::disagrees);
}

TEST_F(RotorStatements, EightIsJudgedAtEveryPhaseAndDirection) {
  axes({"direction", "unbalance_phase", "unbalance", "friction", "damping_ratio"});
  for (const double direction : {0.0, 1.0}) {
    for (const double phase : {0.0, 1.0}) {
      for (const double unbalance : {0.0, 1e-4}) {
        const bool merges = unbalance > 0.0 && direction > 0.5;
        add(merges ? std::vector<Piece>{{1.0 / 3.0, {1}, 1e-4}, {0.95, {kChaos}, 1e-2}} : four_regions(),
            {direction, phase, unbalance, 0.1, 0.1});
      }
    }
  }
  const auto statements = judged("P8");
  ASSERT_EQ(statements.size(), 4U);
  EXPECT_EQ(statements[0].setting.text, "direction = up, γ = 0");
  EXPECT_EQ(statements[1].verdict(), Verdict::partly);
  EXPECT_EQ(statements[2].setting.text, "direction = down, γ = 0");
  EXPECT_EQ(statements[2].verdict(), Verdict::agrees);
}

TEST_F(RotorStatements, SixteenNeedsTheBladeAndNoMotion) {
  on_the_rig();
  axes({"thickness", "friction", "damping_ratio"});
  add({{0.95, {motion_class::kNone}, kNotANumber}}, {0.5e-3, 0.2, 0.05});
  const auto statement = judge("P16");
  EXPECT_EQ(statement.verdict(), Verdict::agrees);
  ASSERT_EQ(statement.findings.size(), 3U);
  EXPECT_EQ(statement.findings[0].evidence, "Euler load 42.03 N");
  // Δ = μ F L³/3EI (1 + F/Fe), 2.10 N at μ = 0.2 (beam-column to first order; MODEL 3.2): 0.346 mm.
  EXPECT_NE(statement.findings[2].evidence.find("0.346 mm (μ = 0.2)"), std::string::npos)
      << statement.findings[2].evidence;
}

TEST_F(RotorStatements, SixteenIsNotCoveredWithoutFriction) {
  on_the_rig();
  axes({"thickness", "friction", "damping_ratio"});
  add(nothing_happens(), {0.5e-3, 0.0, 0.05});
  EXPECT_EQ(judge("P16").findings.back().holds, std::nullopt);
}

TEST_F(RotorStatements, AnEffectThatThePaperHasNotMakesAnotherRotor) {
  scene_.side_load.emplace().force = 1.0;
  axes({"friction", "damping_ratio"});
  add(four_regions(), {0.1, 0.1});
  EXPECT_TRUE(judged("P1").empty());
  EXPECT_EQ(
      why_none_applies(scene_),
      "this is not the paper's default rotor, which is without /side_load; nor is it the paper's test rig");
}

TEST(ReferenceRotor, TheRigHasTheClearanceOfThePaper) {
  EXPECT_NEAR(test_rig().scene.clearance(), 0.35e-3, 1e-12);
}

}  // namespace
}  // namespace rubatlas::analysis

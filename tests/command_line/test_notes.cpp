// What a scene is doubted for, without being stopped.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <string>

#include "assembly/make_line_solver.hpp"
#include "mpi/commands/notes.hpp"
#include "mpi/commands/reach.hpp"
#include "plan/grid.hpp"
#include "point/line_solver.hpp"
#include "program.hpp"
#include "settings/reader.hpp"

namespace rubatlas::mpi {
namespace {

/// All doubts about the default rotor with some sections changed, and these axes, one a line.
std::string doubts(const std::string& sections, const std::string& axes = "") {
  const std::string scene = R"({"grid": {"speed_ratio": 0.5)" + axes + "}, " + sections + "}";
  std::string text;
  for (const auto& doubt : doubts_about(settings::parse_scene(scene))) text += doubt + "\n";
  return text;
}

TEST(Notes, TheDefaultRotorIsNotDoubted) {
  EXPECT_EQ(doubts(R"("title": "default")"), "");
}

TEST(Notes, AModulusInAnotherUnitIsNamed) {
  EXPECT_EQ(doubts(R"("blades": {"youngs_modulus": 206})"),
            "E = 206 Pa is far below any solid; is it 206 GPa, that is 2.06e+11 Pa?\n");
  EXPECT_EQ(doubts(R"("blades": {"youngs_modulus": 206000})"),
            "E = 206000 Pa is far below any solid; is it 206000 MPa, that is 2.06e+11 Pa?\n");
  EXPECT_EQ(doubts(R"("blades": {"youngs_modulus": 1e-5})"), "E = 1e-05 Pa is far below any solid\n");
  EXPECT_EQ(doubts(R"("blades": {"youngs_modulus": 206}, "contact": {"law": "elastic_ring"})"), "")
      << "rigid blades have no modulus";
}

TEST(Notes, AThickBladeIsNoBeam) {
  EXPECT_EQ(doubts(R"("blades": {"thickness": 0.021})"),
            "h = 21 mm is more than a fifth of L = 100 mm: such a blade is no slender beam, as which it is "
            "computed\n");
}

TEST(Notes, ADampingRatioInPerCentIsNamed) {
  EXPECT_EQ(doubts(R"("rotor": {"damping_ratio": 5})"),
            "ζ = 5 is a share of critical damping, beyond 1 the shaft creeps back without vibrating; 5 % is "
            "0.05\n");
}

TEST(Notes, AStaticLoadThatPushesTheShaftThroughTheClearanceIsNamed) {
  EXPECT_EQ(doubts(R"("gravity": {})"),
            "the static load alone moves the shaft by 98.1 mm, more than the clearance\n");
  EXPECT_EQ(doubts(R"("side_load": {"force": 0.9})"), "") << "9 mm";
  const auto under_weight = [](const std::string& radii) {
    return doubts(R"("gravity": {"acceleration": 2}, "sweep": "independent")",
                  R"(, "/ring/radius": )" + radii);
  };
  EXPECT_EQ(under_weight("[0.111, 0.125]"),
            "the static load alone moves the shaft by 20 mm, more than the clearance\n");
  EXPECT_EQ(under_weight("[0.121, 0.125]"), "") << "21 mm and 25 mm are left";
}

TEST(Notes, BladesThatNeverReachTheRingAreNamed) {
  EXPECT_EQ(doubts(R"("rotor": {"misalignment": 0.009})"),
            "the blades never reach the ring: nothing moves, every row is zero\n");
  EXPECT_EQ(
      doubts(R"("rotor": {"misalignment": 0.009}, "side_load": {"force": 0.04})"),
      "the blades never reach the ring: the shaft moves by no more than 0.8 mm, and at equilibrium they "
      "pass the ring at a distance of 1 mm\n")
      << "0.4 mm of static deflection, and as much of vibration about it";
  for (const std::string reaching :
       {R"("rotor": {"misalignment": 0.0099}, "side_load": {"force": 0.04})",
        R"("rotor": {"misalignment": 0.009}, "unequal_blades": {"length_errors": [0.002, 0, 0]})",
        R"("rotor": {"misalignment": 0.009}, "initial": {"vx": 0.0011})",
        R"("rotor": {"misalignment": 0.009}, "support": {"stiffness_yy": -200}, "initial": {"y": 1e-6})"}) {
    EXPECT_EQ(doubts(reaching), "") << reaching;
  }
}

TEST(Notes, NoBladeTouchesWhereItIsSaidThatNoneDoes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  int said = 0;
  int touched = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const std::string text = fmt::format(
        R"({{"rotor": {{"misalignment": {}, "damping_ratio": {}}}, "unbalance": {{"moment": {}, "phase": {}}},
        "side_load": {{"force": {}, "direction": {}}}, "initial": {{"x": {}, "vy": {}}}, "sweep": "{}",
        "protocol": {{"transient_revolutions": 0, "sampled_revolutions": 4}}, "observables": ["max_displacement"],
        "grid": {{"speed_ratio": {{"from": 0.2, "to": 1.4, "count": 5}}}}}})",
        0.009 * any(random), 0.3 * any(random), 0.002 * any(random), 6.0 * any(random), 0.2 * any(random),
        6.0 * any(random), 0.002 * any(random), 0.002 * any(random),
        trial % 3 == 0   ? "up"
        : trial % 3 == 1 ? "down"
                         : "independent");
    SCOPED_TRACE(text);
    const auto scene = settings::parse_scene(text);
    const auto reach = reach_without_contact(scene);
    const plan::Grid grid(scene);
    const auto solver = assembly::make_line_solver(scene, grid.parameters(0), assembly::make_blade_tables());
    const motion::SectionState initial{scene.initial.x, scene.initial.y, scene.initial.vx, scene.initial.vy};
    motion::SectionState start = initial;
    motion::WorkCounts work;
    double farthest = 0.0;
    for (std::size_t visit = 0; visit < grid.speed_count(); ++visit) {
      const auto outcome = solver->run(grid.parameters(grid.point(0, visit)).speed_ratio, start);
      work += outcome.work;
      const bool goes_on = grid.points_depend_on_each_other() && outcome.status == ending::PointStatus::done;
      start = goes_on ? outcome.final_state : initial;
      if (reach) farthest = std::max(farthest, outcome.rows.front().front());
    }
    if (reach) {
      ++said;
      EXPECT_FALSE(has_touched(scene, work));
      EXPECT_LE(farthest, reach->displacement * (1.0 + 1e-12));
    }
    touched += has_touched(scene, work) ? 1 : 0;
  }
  EXPECT_GT(said, 3);
  EXPECT_GT(touched, 10);
}

/// All notes on the default rotor with some sections changed, one a line.
std::string notes(const std::string& sections) {
  std::string text;
  for (const auto& note :
       notes_on(settings::parse_scene(R"({"grid": {"speed_ratio": 0.5}, )" + sections + "}"), {}))
    text += note + "\n";
  return text;
}

TEST(Notes, NamePeriodAndOverlapOnlyWhereTheyAreThoseOfTheRotor) {
  const std::string period = "the natural period is a blade passing, T/3";
  const std::string overlap = "y0 is above the clearance δc, by 0.5 mm";
  const auto says = [](const std::string& sections, const std::string& words) {
    return notes(R"("rotor": {"misalignment": 0.0105}, )" + sections).find(words) != std::string::npos;
  };
  EXPECT_TRUE(says(R"("observables": ["poincare"])", period));
  EXPECT_TRUE(says(R"("observables": ["poincare"])", overlap));
  for (const std::string effect :
       {R"("unequal_blades": {"length_errors": [1e-3, 0, 0]})", R"("wear": {"rate": 1e-9})",
        R"("speed_ripple": {"amplitude": 0.1, "order": 1})", R"("speed_ramp": {"rate": 1e-4})"})
    EXPECT_FALSE(says(effect + R"(, "observables": ["poincare"])", period)) << effect;
  for (const std::string effect : {R"("unequal_blades": {"length_errors": [1e-3, 0, 0]})",
                                   R"("gravity": {"acceleration": 0.3})", R"("side_load": {"force": 0.1})"})
    EXPECT_FALSE(says(effect, overlap)) << effect;
}

TEST(Notes, ASupportThatChangesTheNaturalFrequencyIsNamed) {
  const std::string words = "as if /support had no stiffness";
  EXPECT_NE(notes(R"("support": {"stiffness_xx": 100, "stiffness_yy": 100})").find(words), std::string::npos);
  EXPECT_EQ(notes(R"("support": {"damping_xx": 1})").find(words), std::string::npos);
}

TEST(Notes, RunUpsHaveNoRegionsOfMotionsAtConstantSpeed) {
  const std::string words = "run-ups, and tell nothing of motions at constant speed";
  EXPECT_NE(notes(R"("speed_ramp": {"rate": 1e-4})").find(words), std::string::npos);
  EXPECT_EQ(notes(R"("speed_ramp": {"rate": 0})").find(words), std::string::npos);
}

TEST(Notes, AStaticSagThatIsNotSmallBesideTheClearanceHidesTriggers) {
  const std::string words = "f, the static sag, is up to ";
  EXPECT_NE(notes(R"("side_load": {"force": 0.5})").find(words + "5 mm"), std::string::npos);
  EXPECT_NE(
      notes(
          R"("gravity": {"acceleration": 0.1}, "side_load": {"force": 0.4, "direction": -1.5707963267948966})")
          .find(words + "5 mm"),
      std::string::npos);
  EXPECT_EQ(notes(R"("side_load": {"force": 0.05})").find(words), std::string::npos);
  EXPECT_EQ(notes(R"("unbalance": {"moment": 1e-4})").find(words), std::string::npos);
}

TEST(Notes, TheReportOfAnAtlasSaysWhatEffectsKeepItFromFinding) {
  const Workplace place;
  static_cast<void>(
      place.write("s.json", R"({"grid": {"speed_ratio": [0.5, 0.6]}, "support": {"stiffness_xx": 100},
        "speed_ramp": {"rate": 1e-4}, "protocol": {"transient_revolutions": 2, "sampled_revolutions": 6}})"));
  ASSERT_EQ(place.rubatlas("run s.json -o a.h5 --progress off").code, 0);
  const std::string report = place.rubatlas("analyse a.h5 -o m.h5").output;
  EXPECT_NE(report.find("no motion repeats itself"), std::string::npos) << report;
  EXPECT_NE(report.find("looked for as if /support had no"), std::string::npos) << report;
}

TEST(Notes, ARunSaysThatNothingHasTouched) {
  const Workplace place;
  const auto said = [&](double moment) {
    static_cast<void>(place.write(
        "s.json", fmt::format(R"({{"grid": {{"speed_ratio": [0.5, 0.9]}}, "sweep": "independent", "rotor":
        {{"misalignment": 0.005}}, "unbalance": {{"moment": {}}}, "protocol": {{"transient_revolutions": 2,
        "sampled_revolutions": 6}}}})",
                              moment)));
    return place.rubatlas("run s.json -o a.h5 --overwrite --progress off").messages;
  };
  EXPECT_EQ(said(0.002), "rubatlas: no blade touched the ring at any of the 2 points\n");
  EXPECT_EQ(said(0.004), "") << "at Ω = 0.9";
  EXPECT_TRUE(
      said(0.0002).starts_with("rubatlas: note: the blades never reach the ring: the shaft moves by "));
}

TEST(Notes, WhyEveryPointLeavesTheModelIsSaidWhereItCanBeSeen) {
  const auto reason = [](const std::string& sections) {
    return likely_reason_to_leave(
        settings::parse_scene(R"({"grid": {"speed_ratio": 0.5}, )" + sections + "}"));
  };
  EXPECT_EQ(
      reason(R"("rotor": {"misalignment": 0.07})"),
      "a blade that passes overlaps the ring by 60 mm, and may be shortened by 50 mm (max_shortening 0.5 "
      "of L)");
  EXPECT_EQ(reason(R"("initial": {"x": 0.2})"),
            "`initial` puts the shaft 200.25 mm from the ring's centre, and the ring has a radius of 110 mm");
  EXPECT_EQ(reason(R"("rotor": {"misalignment": 1})"),
            "`misalignment` puts the shaft 1 m from the ring's centre, and the ring has a radius of 110 mm");
  const std::string beyond = "`initial` puts the shaft where a blade reaches 99.4587 mm beyond the ring";
  EXPECT_EQ(reason(R"("initial": {"x": 0.109})"), beyond);
  EXPECT_EQ(likely_reason_to_leave(settings::parse_scene(
                R"({"grid": {"speed_ratio": [1.5, 1.6]}, "sweep": "independent", "initial": {"x": 0.109}})")),
            beyond)
      << "not the speeds";
  EXPECT_EQ(reason(R"("title": "default")"), "");
}

TEST(Notes, ARunSaysThemBeforeItBeginsAndTheReasonWhereEveryPointHasLeft) {
  const Workplace place;
  static_cast<void>(
      place.write("s.json", R"({"grid": {"speed_ratio": [0.3, 0.5]}, "rotor": {"misalignment": 0.07,
    "damping_ratio": 3}, "protocol": {"transient_revolutions": 2, "sampled_revolutions": 1}})"));
  const auto ending = place.rubatlas("run s.json -o a.h5 --progress off");
  EXPECT_EQ(ending.code, 0);
  EXPECT_TRUE(ending.messages.starts_with("rubatlas: note: ζ = 3 is a share of critical damping"))
      << ending.messages;
  EXPECT_NE(ending.messages.find("\nrubatlas: every point left the model, 2 of 2 since "), std::string::npos)
      << ending.messages;
  EXPECT_NE(ending.messages.find("overlaps the ring by 60 mm"), std::string::npos) << ending.messages;
}

}  // namespace
}  // namespace rubatlas::mpi

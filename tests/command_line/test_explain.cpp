// What `explain` says of a scene.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "explained.hpp"
#include "mpi/commands/estimate.hpp"
#include "mpi/commands/explain.hpp"
#include "mpi/commands/notes.hpp"
#include "settings/effects/list.hpp"
#include "settings/quantity.hpp"
#include "settings/reader.hpp"
#include "settings/scene_file.hpp"

namespace rubatlas::mpi {
namespace {

TEST(Explain, SaysWhichEffectsAreOnAndWhy) {
  const std::string plain = explained(kSmallScene);
  EXPECT_TRUE(holds(line_of(plain, "elastic blades"), " on "));
  EXPECT_TRUE(holds(line_of(plain, "elastic ring"), " off "));
  EXPECT_TRUE(holds(line_of(plain, "friction"), " on   Coulomb, μ = 0.1")) << plain;
  EXPECT_TRUE(holds(line_of(plain, "unbalance"), " off  no section `unbalance`"));
  EXPECT_TRUE(holds(line_of(plain, "yield flag"), " off "));
  EXPECT_TRUE(holds(line_of(plain, "flight"), "closed form"));

  const std::string other = explained(R"({"grid": {"speed_ratio": 0.3, "unbalance": [0, 1e-5]},
    "contact": {"law": "elastic_ring", "friction": 0}, "validity": {"yield_strain": 0.002},
    "protocol": {"transient_revolutions": 2, "sampled_revolutions": 2}})");
  EXPECT_TRUE(holds(line_of(other, "elastic blades"), " off "));
  EXPECT_TRUE(holds(line_of(other, "elastic ring"), "kr = 1e+04 N/m, 100 shaft stiffnesses"));
  EXPECT_TRUE(holds(line_of(other, "friction"), " off "));
  EXPECT_TRUE(holds(line_of(other, "unbalance"), " on   me = 0, 1e-05 kg m")) << other;
  EXPECT_TRUE(holds(line_of(other, "yield flag"), " on   root strain above 0.002"));
}

/// What follows the line of a name, up to the next name.
std::string below(const std::string& text, const std::string& name) {
  auto at = text.find("\n  " + name + " ");
  if (at == std::string::npos) return "no such line";
  at = text.find('\n', at + 1);
  auto end = at;
  while (text.compare(end, 5, "\n    ") == 0) end = text.find('\n', end + 1);
  return text.substr(at, end - at);
}

TEST(Explain, ListsEveryEffectWithWhatItCostsAndWhetherFlightStaysExact) {
  const std::string plain = explained(kSmallScene);
  effects::for_each_effect([&]<auto Effect>() {
    constexpr auto& kDescription = effects::Settings<Effect>::kDescription;
    const std::string name = settings::axis_name(kDescription.section);
    SCOPED_TRACE(name);
    EXPECT_TRUE(holds(line_of(plain, name), " off  no section `" + name + "`")) << line_of(plain, name);
    EXPECT_EQ(below(plain, name), "") << "nothing to say of an effect that is off";

    const std::string with =
        explained(settings::read_text(RUBATLAS_SOURCE_DIR "/jobs/effect_" + name + ".json"), "0.15");
    EXPECT_TRUE(holds(line_of(with, name), " on   ")) << line_of(with, name);
    const std::string more = below(with, name);
    EXPECT_TRUE(holds(more, std::string(kDescription.equation))) << more;
    EXPECT_TRUE(holds(more, "flight: " + std::string(kDescription.flight))) << more;
    // Whether there is time for it is a matter of the clock.
    if (holds(more, "not measured: its motions take too long for that here")) return;
    const auto at = more.find("measured: ");
    ASSERT_NE(at, std::string::npos) << more;
    double cost = 0.0;
    double cost_without = 0.0;
    ASSERT_EQ(std::sscanf(more.c_str() + at,
                          "measured: %lf ns a right-hand side with its share of flight, %lf without it",
                          &cost, &cost_without),
              2)
        << more;
    EXPECT_GT(cost, 10.0) << "ns: no computer is as fast";
    EXPECT_GT(cost_without, 10.0);
  });
}

TEST(Explain, SaysWhatEachObservableAddsToTheTime) {
  const std::string text = explained(R"({"grid": {"speed_ratio": 0.36},
    "observables": ["poincare", "spectrum", "lyapunov"]})",
                                     "1");
  if (holds(line_of(text, "each"), "motions take too long")) return;  // a matter of the clock
  EXPECT_TRUE(holds(line_of(text, "each"), "measured: what it alone adds")) << text;
  for (const std::string observable : {"poincare", "spectrum", "lyapunov"}) {
    const std::string line = line_of(text, observable);
    EXPECT_TRUE(holds(line, "next to nothing") || holds(line, " %")) << line;
  }
}

/// Explained with the sections, without time to measure anything.
std::string explained_at_once(const std::string& sections) {
  const auto scene = settings::parse_scene(
      R"({"grid": {"speed_ratio": 0.5}, "protocol": {"transient_revolutions": 1, "sampled_revolutions": 1})" +
      (sections.empty() ? "" : ", " + sections) + "}");
  int looks = 0;
  return explain(scene, 0.01, [&] { return 1.0 * looks++; });
}

TEST(Explain, SaysOfEachMethodHowItFliesAndHowItIntegratesContact) {
  const auto with = [](const std::string& method, const std::string& more = "") {
    return explained_at_once(R"("accuracy": {"method": ")" + method + R"("}, "unbalance": {"moment": 1e-5})" +
                             more);
  };
  const std::string bending = "; the bending of each blade is a root in each stage";
  for (const auto& [method, pair] :
       {std::pair{"hybrid", "Dormand-Prince 8(5,3)"}, std::pair{"hybrid_54", "Dormand-Prince 5(4)"},
        std::pair{"hybrid_32", "Bogacki-Shampine 3(2)"}}) {
    const std::string text = with(method);
    EXPECT_TRUE(line_of(text, "method").ends_with(std::string(" ") + method));
    EXPECT_TRUE(holds(line_of(text, "flight"), " closed form: ")) << line_of(text, "flight");
    EXPECT_TRUE(holds(line_of(text, "contact"), pair + bending)) << line_of(text, "contact");
    EXPECT_TRUE(holds(line_of(text, "touch-down, lift-off"), "located on dense output"));
    EXPECT_TRUE(holds(line_of(text, "accuracy"), "1e-09 of the clearance"));
    EXPECT_TRUE(holds(below(text, "unbalance"), "flight: closed form"));
  }
  EXPECT_TRUE(holds(line_of(with("collocation"), "touch-down, lift-off"), "the end of an interval"));
  for (
      const std::string acts :
      {R"("gravity": {"acceleration": 9.81})", R"("stick": {})", R"("wear": {})",
       R"("contact": {"friction": 0})", R"("contact": {"friction": 0}, "axial_compliance": {})",
       R"("contact": {"friction": 0}, "yielding_ring": {"compliance": 1e-5})",
       R"("contact": {"law": "elastic_ring"}, "ring_body": {"mass": 0})",
       R"("contact": {"law": "elastic_ring"}, "contact_damping": {"damping": 10})",
       R"("yielding_ring": {"compliance": 1e-5}, "contact_damping": {"damping": 10})",
       R"("contact": {"friction": 0}, "yielding_ring": {"compliance": 1e-5}, "contact_damping": {"damping": 10})",
       R"("contact": {"friction": 2}, "validity": {"max_shortening": 0.6})"}) {
    const std::string text = with("collocation", ", " + acts);
    EXPECT_TRUE(holds(line_of(text, "contact"), "Radau IIA 15")) << line_of(text, "contact");
  }
  struct Stepped {
    std::string method, flight, contact, guards, accuracy;
  };
  for (const Stepped& expected :
       {Stepped{"located", "Dormand-Prince 5(4), in steps of at most 0.02 in τ over flight and contact alike",
                "in the same steps; the force of each blade: a root in each stage",
                " located on dense output", "1e-09 of the clearance"},
        Stepped{"paper", "Fehlberg 4(5), the solution of order 4, in steps of at most 0.02 in τ over flight",
                "changes sign, dF = 0.04 N", " not located: ", "1e-09 of the clearance"},
        Stepped{"fixed",
                "classical Runge-Kutta of order 4, in steps of 0.001 in τ, shortened to a whole number",
                "in the same steps; the force of each blade: a root in each stage",
                " not located: ", "`accuracy.tolerance` is not read"}}) {
    SCOPED_TRACE(expected.method);
    const std::string text = with(expected.method);
    EXPECT_TRUE(holds(line_of(text, "flight"), " no closed form: " + expected.flight))
        << line_of(text, "flight");
    EXPECT_TRUE(holds(line_of(text, "contact"), expected.contact)) << line_of(text, "contact");
    EXPECT_TRUE(holds(line_of(text, "touch-down, lift-off"), expected.guards));
    EXPECT_TRUE(holds(line_of(text, "accuracy"), expected.accuracy)) << line_of(text, "accuracy");
    EXPECT_TRUE(holds(below(text, "unbalance"), "flight: in the steps of the method"));
    const std::string rigid = with(expected.method, R"(, "contact": {"law": "elastic_ring"})");
    EXPECT_TRUE(holds(line_of(rigid, "contact"), "in the same steps; the force of each blade is explicit"));
  }
}

TEST(Explain, SaysWhichMotionASceneHasAndHowItsContactIsIntegrated) {
  const auto expect = [](const std::string& sections, const std::string& motion, const std::string& flight,
                         const std::string& contact) {
    SCOPED_TRACE(sections);
    const std::string text = explained_at_once(sections);
    EXPECT_TRUE(line_of(text, "motion").ends_with(" " + motion)) << line_of(text, "motion");
    EXPECT_TRUE(holds(line_of(text, "flight"), flight)) << line_of(text, "flight");
    EXPECT_TRUE(holds(line_of(text, "contact"), "Radau IIA 15, along the arc of the contact; " + contact))
        << line_of(text, "contact");
  };
  const std::string isotropic = "complex exponentials of the isotropic shaft; no touch-down";
  const std::string rigid = R"("contact": {"law": "elastic_ring", "friction": 0.3}, )";
  expect("", "the paper's rotor with elastic blades", isotropic, "the bending of each blade is found");
  expect(rigid + R"("ring": {"stiffness": 1e4})", "the paper's rotor with rigid blades on an elastic ring",
         isotropic, "the force of each blade is explicit");
  expect(rigid + R"("gravity": {}, "stribeck": {"static_friction": 0.5})",
         "rigid blades; with gravity, stribeck", isotropic, "the force of each blade is explicit");
  expect(rigid + R"("stick": {})", "rigid blades whose tips may stick; with stick", isotropic,
         "the force of each blade is explicit; the friction that holds tips at rest");
  expect(R"("load_direction": {}, "support": {"stiffness_xx": 1})",
         "elastic blades under a load along the contact normal, or with friction that depends on the slip "
         "velocity; "
         "with support, load_direction",
         "the exponential of the matrix of shaft and support;", "the bends of all");
  expect(R"("stick": {})", "elastic blades whose tips may stick; with stick", isotropic,
         "the bends of all blades in contact, two numbers each, are found along");
  expect(R"("release": {})", "elastic blades; with release", isotropic, "the bending of each blade is found");
  expect(R"("ring_body": {})", "elastic blades in a ring that is a body; with ring_body",
         "isotropic shaft, the ring oscillates freely beside the shaft;", "the bending");
  expect(rigid + R"("ring_body": {"mass": 0})", "rigid blades in a ring without mass; with ring_body",
         "the ring stays at its place of rest", "the forces of all blades and the place of the ring");
}

TEST(Explain, SaysWhichMotionsTheLinesOfAGridHave) {
  const auto scene = settings::parse_scene(R"({"grid": {"speed_ratio": 0.5, "/side_load/force": [0, 0.1],
    "unbalance": [0, 1e-5]}, "protocol": {"transient_revolutions": 1, "sampled_revolutions": 1}})");
  int looks = 0;
  const std::string text = explain(scene, 0.01, [&] { return 1.0 * looks++; });
  EXPECT_TRUE(holds(text, " the paper's rotor with elastic blades; on some lines with unbalance\n")) << text;
  EXPECT_TRUE(holds(text, " elastic blades; with side_load; on some lines with unbalance\n")) << text;
}

TEST(Explain, SaysThatNothingSticksWithoutFriction) {
  const std::string text = explained_at_once(R"("contact": {"friction": 0}, "stick": {})");
  EXPECT_TRUE(
      holds(line_of(text, "stick"), " off  holds = true, μs/μ = 1: nothing to act on without friction"))
      << line_of(text, "stick");
  EXPECT_TRUE(line_of(text, "motion").ends_with(" the paper's rotor with elastic blades"));
}

TEST(Explain, SaysWhereAnEffectHasNoStrengthAndOnHowManyLinesItActs) {
  const std::string zero = explained(R"({"grid": {"speed_ratio": 0.5}, "side_load": {"force": 0},
    "protocol": {"transient_revolutions": 2, "sampled_revolutions": 2}})");
  EXPECT_TRUE(holds(line_of(zero, "side_load"),
                    " off  w = 0 N, α = 0 rad: of zero strength, no term in the equations"))
      << line_of(zero, "side_load");
  const std::string swept = explained(R"({"grid": {"speed_ratio": 0.5, "/side_load/force": [0, 0.05, 0.1]},
    "protocol": {"transient_revolutions": 2, "sampled_revolutions": 2}})");
  EXPECT_TRUE(
      holds(line_of(swept, "side_load"), " on   w = 0, 0.05, 0.1 N, α = 0 rad; no term on 1 of 3 lines"))
      << line_of(swept, "side_load");
}

TEST(Explain, GivesGridShapesAndBytesOfTheAtlas) {
  const std::string text = explained(kSmallScene);
  EXPECT_TRUE(holds(line_of(text, "points"), " 6  on 2 lines along speed_ratio; sweep up"));
  EXPECT_TRUE(holds(line_of(text, "/poincare"), "1 × 1 × 1 × 2 × 3 × 3 × 4"));
  EXPECT_TRUE(holds(line_of(text, "/spectrum"), "1 × 1 × 1 × 2 × 3 × 37"));
  // 6 points: status, its detail and restarted 1 byte, settled 2, checksum and failed revolution 4, final
  // state 32, sections 96, displacement 8, spectrum 296
  EXPECT_TRUE(holds(line_of(text, "together"), "2.67 kB")) << text;
}

TEST(Explain, NamesWhatAUserShouldKnowBeforehand) {
  EXPECT_TRUE(
      holds(explained(R"({"grid": {"speed_ratio": 1.2}, "protocol": {"sampled_revolutions": 1}})"),
            "reach the border of the model, where blades can no longer push a rotor back that leaves."));
  EXPECT_TRUE(holds(explained(R"({"grid": {"speed_ratio": 0.5}, "rotor": {"misalignment": 0.009}})"),
                    "the blades never reach the ring"));
}

TEST(Explain, NotesAMisalignmentOrAStartBeyondTheClearance) {
  const auto with = [](const std::string& sections) {
    return explained(R"({"grid": {"speed_ratio": 0.5}, "protocol": {"sampled_revolutions": 1})" + sections +
                     "}");
  };
  EXPECT_TRUE(holds(with(""), "y0 is above the clearance δc, by 10 µm: blades rub at every speed"));
  const auto free = with(R"(, "rotor": {"misalignment": 0.0099})");
  EXPECT_FALSE(holds(free, "above the clearance"));
  EXPECT_FALSE(holds(free, "`initial` puts"));
  EXPECT_TRUE(
      holds(with(R"(, "rotor": {"misalignment": 0.005}, "initial": {"y": 0.006})"),
            "`initial` puts the shaft 11 mm from the ring's centre, farther than the clearance of 10 mm"));
  EXPECT_FALSE(
      holds(with(R"(, "rotor": {"misalignment": 0.005}, "initial": {"y": 0.004})"), "`initial` puts"));
}

/// The notes in which some words occur, all points being tried.
std::string noted(const std::string& words, const std::string& sections) {
  const auto scene = settings::parse_scene(
      R"({"protocol": {"transient_revolutions": 8, "sampled_revolutions": 4}, "sweep": "independent", )" +
      sections + "}");
  std::string text;
  for (const auto& note : notes_on(scene, estimate_cost(scene, 1.0, [] { return 0.0; }))) {
    if (holds(note, words)) text += note + "\n";
  }
  return text;
}
std::string contacts_noted(const std::string& sections) {
  return noted("the ring", sections);
}

TEST(Explain, NotesAnAxisOfWhatRigidBladesDoNotHave) {
  const std::string over_thickness = R"("grid": {"speed_ratio": 0.5, "thickness": [0.001, 0.002]})";
  const auto idle = [](const std::string& sections) { return noted("rigid", sections); };
  EXPECT_EQ(
      idle(R"("contact": {"law": "elastic_ring"}, )" + over_thickness),
      "thickness has no effect under the contact law \"elastic_ring\", whose blades are rigid: points that "
      "differ in it alone are the same motion\n");
  EXPECT_EQ(idle(R"("contact": {"law": "elastic_ring"}, "grid": {"speed_ratio": [0.4, 0.5]})"), "");
  EXPECT_EQ(idle(over_thickness), "") << "elastic blades";
}

TEST(Explain, SaysOfWhichPointsNoneHasTouchedTheRing) {
  // Blades pass at a distance of 5 mm; the unbalance moves the shaft by 15 mm at resonance, by a tenth of
  // that away from it.
  const std::string unbalanced =
      R"("rotor": {"misalignment": 0.005, "damping_ratio": 0.02}, "unbalance": {"moment": 0.0006}, )";
  EXPECT_EQ(
      contacts_noted(unbalanced + R"("grid": {"speed_ratio": {"from": 0.1, "to": 0.9, "count": 40}})"),
      "none of the 40 points tried touched the ring, in 12 revolutions or fewer each from `initial`: are "
      "misalignment, clearance and loads as intended?\n");
  const std::string partly =
      contacts_noted(unbalanced + R"("grid": {"speed_ratio": {"from": 0.1, "to": 2.5, "count": 49}})");
  EXPECT_TRUE(partly.starts_with("the lower speeds may be without any contact: none of the ")) << partly;
  EXPECT_TRUE(holds(partly, " points tried from Ω = 0.1 to 0.")) << partly;
  EXPECT_TRUE(holds(partly, "\nthe upper speeds may be without any contact: none of the ")) << partly;
  EXPECT_TRUE(holds(partly, " to 2.5 touched the ring")) << partly;
  EXPECT_EQ(contacts_noted(R"("grid": {"speed_ratio": {"from": 0.1, "to": 0.85, "count": 40}})"), "")
      << "the default rotor rubs at every speed";
}

}  // namespace
}  // namespace rubatlas::mpi

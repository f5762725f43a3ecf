// Where blades touch the ring: the rule at a point, and what it makes of a line.
#include "analysis/rules/contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "analysis/rules/free_shaft.hpp"
#include "analysis/rules/line_summary.hpp"
#include "settings/reader.hpp"
#include "synthetic_line.hpp"

namespace rubatlas::analysis {
namespace {

constexpr double kSpeedOfFreeMotion = 0.6;
const ClosingTolerance kEqualSections{.relative = 1e-6, .floor = 1e-9};

/// A rotor with a clearance of 10 mm, an unbalance and a side load.
settings::Scene loaded() {
  return settings::parse_scene(
      R"({"grid": {"speed_ratio": 0.6}, "rotor": {"misalignment": 0.005}, "side_load": {"force": 0.05},
          "unbalance": {"moment": 1e-3, "phase": 0.3}})");
}

/// Sections of the free motion of a scene, worked out with e^{λτ} instead of the kernels of `FreeShaft`.
std::vector<double> free_sections(const settings::Scene& scene, std::size_t count) {
  using Complex = std::complex<double>;
  const double damping = scene.rotor.damping_ratio;
  const double damped = std::sqrt(1.0 - damping * damping);
  const Complex circle =
      1e-3 * std::polar(1.0, 0.3) * kSpeedOfFreeMotion * kSpeedOfFreeMotion /
      Complex(1.0 - kSpeedOfFreeMotion * kSpeedOfFreeMotion, 2.0 * damping * kSpeedOfFreeMotion);
  std::vector<double> sections;
  for (std::size_t i = 0; i < count; ++i) {
    const double time = 2.0 * std::numbers::pi / kSpeedOfFreeMotion * static_cast<double>(i);
    const Complex rate(-damping, damped);
    const Complex vibration = 2e-4 * std::exp(rate * time);
    const Complex place = vibration + circle + 0.05 / 100.0;
    const Complex velocity = rate * vibration + Complex(0.0, kSpeedOfFreeMotion) * circle;
    sections.insert(sections.end(), {place.real(), place.imag(), velocity.real(), velocity.imag()});
  }
  return sections;
}

TEST(Contact, AFigureThatTheAtlasKeepsDecides) {
  const auto scene = loaded();
  EXPECT_EQ(contact_at(scene, kSpeedOfFreeMotion, {.figure = 0.1}, kEqualSections).contact, Contact::touches);
  const auto none =
      contact_at(scene, kSpeedOfFreeMotion, {.figure = 0.0, .nearest_miss = 2e-3}, kEqualSections);
  EXPECT_EQ(none.contact, Contact::none);
  EXPECT_EQ(none.distance, 2e-3);
}

TEST(Contact, WithoutAFigureFreeMotionInsideTheRingIsWithoutContactAndAKickIsATouch) {
  const auto scene = loaded();
  auto sections = free_sections(scene, 6);
  EXPECT_EQ(contact_at(scene, kSpeedOfFreeMotion, {.sections = sections}, kEqualSections).contact,
            Contact::none);
  sections[4 * 3 + 2] += 1e-7;  // a kick of 0.1 µm per unit τ before the fourth
  EXPECT_EQ(contact_at(scene, kSpeedOfFreeMotion, {.sections = sections}, kEqualSections).contact,
            Contact::touches);
  EXPECT_EQ(contact_at(scene, kSpeedOfFreeMotion, {}, kEqualSections).contact, Contact::not_known);
  const auto one = std::span(sections).first(4);
  EXPECT_EQ(contact_at(scene, kSpeedOfFreeMotion, {.sections = one}, kEqualSections).contact,
            Contact::not_known)
      << "nothing follows from one section";
}

TEST(Contact, ASupportThatMovesTheShaftOtherwiseLeavesContactUnknown) {
  auto scene = loaded();
  scene.support.emplace().stiffness_yy = 50.0;
  const auto sections = free_sections(scene, 6);
  EXPECT_EQ(contact_at(scene, kSpeedOfFreeMotion, {.sections = sections}, kEqualSections).contact,
            Contact::not_known);
  EXPECT_EQ(
      contact_at(scene, kSpeedOfFreeMotion, {.figure = 0.0, .sections = sections}, kEqualSections).contact,
      Contact::none);
}

/// Sections of a shaft that is at rest there, whatever happened before.
const std::vector<double> kAtRest(4 * 6, 0.0);

PointContact at_rest(const std::string& sections_of_scene, const ContactEvidence& evidence) {
  const auto scene = settings::parse_scene(R"({"grid": {"speed_ratio": 1.0}, )" + sections_of_scene + "}");
  return contact_at(scene, 1.0, evidence, kEqualSections);
}

TEST(Contact, AKickThatDiesOutBeforeTheNextSectionDoesNotHideThatTheShaftCannotRestWithoutContact) {
  const auto contact = [](const std::string& misalignment) {
    return at_rest(R"("rotor": {"misalignment": )" + misalignment + "}", {.sections = kAtRest}).contact;
  };
  EXPECT_EQ(contact("0.0101"), Contact::touches);
  EXPECT_EQ(contact("-0.0101"), Contact::touches);
  EXPECT_EQ(contact("0.0099"), Contact::none);
}

TEST(Contact, AVibrationThatMayReachTheRingLeavesContactUnknown) {
  const auto scene = settings::parse_scene(
      R"({"grid": {"speed_ratio": 1.0}, "rotor": {"misalignment": 0.009, "damping_ratio": 0}})");
  const auto contact = [&](double x, double y) {
    std::vector<double> sections;
    for (int i = 0; i < 6; ++i) sections.insert(sections.end(), {x, y, 0.0, 0.0});
    return contact_at(scene, 1.0, {.sections = sections}, kEqualSections);
  };
  EXPECT_EQ(contact(0.0, 2e-3).contact, Contact::not_known);
  EXPECT_EQ(contact(0.0, 0.9e-3).contact, Contact::none);
  const auto along_the_ring = contact(2e-3, 0.0);
  EXPECT_EQ(along_the_ring.contact, Contact::none) << "its tips pass beside the nearest place of the ring";
  EXPECT_NEAR(along_the_ring.distance, 0.01 - std::hypot(0.009, 2e-3), 1e-6);
}

TEST(Contact, AnUndampedShaftDrivenAtItsNaturalFrequencyHasNoSteadyMotionToJudgeBy) {
  const std::string driven =
      R"("rotor": {"misalignment": 0.005, "damping_ratio": 0}, "unbalance": {"moment": )";
  EXPECT_EQ(at_rest(driven + "1e-6}", {.sections = kAtRest}).contact, Contact::not_known);
  EXPECT_EQ(at_rest(driven + "1e-6}", {.max_displacement = 4e-3, .sections = kAtRest}).contact,
            Contact::none);
  EXPECT_EQ(at_rest(driven + "0}", {.sections = kAtRest}).contact, Contact::none);
}

TEST(Contact, AShaftThatNeverComesSoFarTouchesNothingWhateverMovesIt) {
  const std::string supported = R"("rotor": {"misalignment": 0.005}, "support": {"stiffness_yy": 50})";
  EXPECT_EQ(at_rest(supported, {.max_displacement = 4.9e-3}).contact, Contact::none);
  EXPECT_EQ(at_rest(supported, {.max_displacement = 5.1e-3}).contact, Contact::not_known);
  EXPECT_EQ(at_rest(supported + R"(, "unequal_blades": {"length_errors": [1e-3, 0, 0]})",
                    {.max_displacement = 4.9e-3})
                .contact,
            Contact::not_known);
}

TEST(Contact, UnequalBladesReachAsFarAsTheLongestOfThem) {
  const auto contact = [](const std::string& misalignment, const std::string& errors) {
    return at_rest(
               R"("rotor": {"misalignment": )" + misalignment + R"(}, "unequal_blades": {)" + errors + "}",
               {.sections = kAtRest})
        .contact;
  };
  EXPECT_EQ(contact("0.0099", R"("length_errors": [0, 2e-4, 0])"), Contact::touches);
  EXPECT_EQ(contact("0.0097", R"("length_errors": [0, 2e-4, 0])"), Contact::none);
  EXPECT_EQ(contact("0.0101", R"("length_errors": [-2e-4, -2e-4, -3e-4])"), Contact::none);
  EXPECT_EQ(contact("0.0101", R"("length_errors": [-2e-4, 0, -3e-4])"), Contact::touches);
  effects::UnequalBlades drawn;
  drawn.length_spread = 1e-3;
  const auto errors = drawn.errors(3);
  const double room = 0.01 - std::max({errors[0].length, errors[1].length, errors[2].length});
  EXPECT_EQ(contact(std::to_string(room + 1e-5), R"("length_spread": 1e-3)"), Contact::touches);
  EXPECT_EQ(contact(std::to_string(room - 1e-5), R"("length_spread": 1e-3)"), Contact::none);
  const std::string supported =
      R"("rotor": {"misalignment": 0.005}, "support": {"stiffness_yy": 50}, "unequal_blades":
         {"length_errors": [1e-3, 0, 0]})";
  EXPECT_EQ(at_rest(supported, {.max_displacement = 3.9e-3}).contact, Contact::none);
  EXPECT_EQ(at_rest(supported, {.max_displacement = 4.1e-3}).contact, Contact::not_known);
}

TEST(Contact, TheDistanceOfUnequalBladesIsThatOfTheOutermostTipOnItsCircle) {
  auto scene = loaded();
  scene.unequal_blades.emplace().length_errors = {-5e-3, 1e-3, 0.0};
  scene.unequal_blades->angle_errors = {0.0, -1.0, 0.5};
  const auto errors = scene.unequal_blades->errors(3);
  const FreeShaft shaft(scene, kSpeedOfFreeMotion);
  double farthest = 0.0;  // of all tips, at 3600 angles of a revolution
  for (int step = 0; step < 3600; ++step) {
    const auto turn = std::polar(1.0, 2.0 * std::numbers::pi * step / 3600.0);
    for (std::size_t blade = 0; blade < 3; ++blade) {
      const double place = 2.0 * std::numbers::pi * static_cast<double>(blade) / 3.0 + errors[blade].angle;
      const auto tip =
          shaft.deflection() + turn * (shaft.circle() + std::polar(0.1 + errors[blade].length, place));
      farthest = std::max(farthest, std::abs(tip + FreeShaft::Complex(0.0, 0.005)));
    }
  }
  EXPECT_NEAR(shaft.distance(), 0.11 - farthest, 1e-8);
}

TEST(Contact, WornBladesAreFartherFromTheRingThanTheSceneSays) {
  const std::string wears = R"("wear": {"rate": 1e-5, "carries_over": true}, "rotor": {"misalignment": )";
  const auto apart = at_rest(wears + "0.009}", {.figure = 0.0, .sections = kAtRest});
  EXPECT_EQ(apart.contact, Contact::none);
  EXPECT_TRUE(std::isnan(apart.distance));
  EXPECT_EQ(at_rest(wears + "0.009}", {.sections = kAtRest}).contact, Contact::none);
  EXPECT_EQ(at_rest(wears + "0.0101}", {.sections = kAtRest}).contact, Contact::not_known);
}

TEST(Contact, TheDistanceIsThatOfTheOutermostTipOnItsCircle) {
  const auto scene = loaded();
  const FreeShaft shaft(scene, kSpeedOfFreeMotion);
  double farthest = 0.0;  // of all tips, at 3600 angles of a revolution
  for (int step = 0; step < 3600; ++step) {
    const auto turn = std::polar(1.0, 2.0 * std::numbers::pi * step / 3600.0);
    for (int blade = 0; blade < 3; ++blade) {
      const auto tip = shaft.deflection() + turn * shaft.circle() +
                       turn * std::polar(0.1, 2.0 * std::numbers::pi * blade / 3.0);
      farthest = std::max(farthest, std::abs(tip + FreeShaft::Complex(0.0, 0.005)));
    }
  }
  EXPECT_NEAR(shaft.distance(), 0.11 - farthest, 1e-8);
}

/// The sentence of a line of ten speeds from 0.1 to 1.0, one letter a point: c contact, - none, ? not known,
/// x not done.
std::string sentence(const std::string& points) {
  Line line;
  for (std::size_t i = 0; i < points.size(); ++i) {
    line.speed_ratio.push_back(0.1 * static_cast<double>(i + 1));
    line.motion.push_back(points[i] == 'x' ? motion_class::kNone : std::uint8_t{1});
    line.max_displacement.push_back(points[i] == 'x' ? kNotANumber : 1e-3);
    const double distance = 1e-3 * std::abs(static_cast<double>(i) - 6.0) + 0.38e-3;
    line.contact.push_back(points[i] == 'c'   ? PointContact{Contact::touches}
                           : points[i] == '-' ? PointContact{Contact::none, distance}
                                              : PointContact{});
  }
  return summarise_contact(line).text;
}

TEST(Contact, ALineSaysWhereBladesFirstTouchOrHowCloseTheyCome) {
  EXPECT_EQ(sentence("----------"), "no contact; closest 0.38 mm at Ω = 0.7");
  EXPECT_EQ(sentence("cccccccccc"), "contact at every speed");
  EXPECT_EQ(sentence("ccccccccxx"), "contact at every speed; 2 speeds are not done");
  EXPECT_EQ(sentence("cccccccccx"), "contact at every speed; 1 speed is not done");
  EXPECT_EQ(sentence("----cccccc"), "first contact at Ω = 0.5; elsewhere closest 3.38 mm at Ω = 0.4");
  EXPECT_EQ(
      sentence("cccc------"),
      "contact from the lowest speed on, last contact at Ω = 0.4; elsewhere closest 0.38 mm at Ω = 0.7");
  EXPECT_EQ(
      sentence("--c-c--c--"),
      "first contact at Ω = 0.3, last contact at Ω = 0.8, none at 3 of the speeds in between; elsewhere "
      "closest 0.38 mm at Ω = 0.7");
  EXPECT_EQ(sentence("------c---"), "contact at Ω = 0.7 only; elsewhere closest 1.38 mm at Ω = 0.6");
  EXPECT_EQ(sentence("xx--cccccx"),
            "first contact at Ω = 0.5; elsewhere closest 3.38 mm at Ω = 0.4; 3 speeds are not done");
  EXPECT_EQ(sentence("??????????"),
            "whether blades touch is not known: the observable `contact_fraction` tells");
  EXPECT_EQ(
      sentence("-----??ccc"),
      "first contact at Ω = 0.8; elsewhere closest 2.38 mm at Ω = 0.5; whether blades touch is not known "
      "at 2 speeds: the observable `contact_fraction` tells");
  EXPECT_EQ(sentence("xxxxxxxxxx"), "");
}

/// The paper's picture with contact at speeds from `first` on only.
LineSummary with_contact_from(double first) {
  auto line = line_of(0.05, 901, four_regions());
  for (const double speed : line.speed_ratio)
    line.contact.push_back({speed < first ? Contact::none : Contact::touches, 1e-3});
  return summarise(std::move(line), {}, kThreeBlades, 1e-8);
}

TEST(Contact, NoRegionAndNoTriggerIsFoundWhereNothingTouches) {
  const auto nowhere = with_contact_from(2.0);
  for (const auto& region : nowhere.regions) EXPECT_EQ(region.presence, Presence::absent);
  for (const auto& trigger : nowhere.triggers) EXPECT_EQ(trigger.presence, Presence::absent);

  const auto late = with_contact_from(0.6);
  EXPECT_EQ(late.triggers[0].presence, Presence::absent);
  EXPECT_EQ(late.regions[0].presence, Presence::absent);
  EXPECT_EQ(late.regions[1].presence, Presence::absent);
  EXPECT_NEAR(late.regions[2].from, 0.6, 1e-9) << "region 3 begins where a blade first touches";
  EXPECT_EQ(late.regions[3].presence, Presence::present);

  const auto everywhere = with_contact_from(0.0);
  for (const auto& region : everywhere.regions) EXPECT_EQ(region.presence, Presence::present);
}

}  // namespace
}  // namespace rubatlas::analysis

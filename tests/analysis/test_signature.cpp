// Signs of rubbing in spectra and along lines that are prescribed.
#include "analysis/rules/signature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "analysis/displacement_limit.hpp"

namespace rubatlas::analysis {
namespace {

constexpr std::size_t kPassing = 0;
constexpr std::size_t kBroad = 1;
constexpr std::size_t kSubharmonic = 2;

/// Orders 0, 0.01, ..., 12.
std::vector<double> orders() {
  std::vector<double> result;
  for (int i = 0; i <= 1200; ++i) result.push_back(i / 100.0);
  return result;
}

TEST(Signature, ALineAtTheBladePassingHasNothingBetween) {
  std::vector<double> amplitudes(1201, 0.0);
  amplitudes[0] = 5.0;
  amplitudes[300] = 2.0;
  amplitudes[302] = 3.0;  // what has leaked
  const auto heights = sign_heights(orders(), amplitudes, 3);
  EXPECT_EQ(heights[kPassing], 3.0);
  EXPECT_EQ(heights[kBroad], 0.0);
  EXPECT_EQ(heights[kSubharmonic], 0.0);
}

TEST(Signature, LinesOfAMotionOfPeriodTwoAreNoBroadBand) {
  std::vector<double> amplitudes(1201, 0.0);
  for (std::size_t i = 50; i < amplitudes.size(); i += 50)
    amplitudes[i] = 1.0 + 0.01 * static_cast<double>(i);
  const auto heights = sign_heights(orders(), amplitudes, 3);
  EXPECT_EQ(heights[kBroad], 0.0);
  EXPECT_EQ(heights[kSubharmonic], 6.5) << "up to half a line above 6x no higher line is between";
}

TEST(Signature, AFlatSpectrumIsAsBroadAsItsPowerSays) {
  const auto heights = sign_heights(orders(), std::vector(1201, 1e-3), 3);
  // Seven whole orders keep 11 bins each, 0 only those above it; 6.05 is the last bin.
  const double bins = 606.0 - 6.0 * 11.0 - 6.0;
  EXPECT_NEAR(heights[kBroad], 1e-3 * std::sqrt(bins / std::numbers::ln2), 1e-15);
}

TEST(Signature, OrdersThatDoNotResolveLinesOrEndBelowTwiceTheBladePassingShowNothing) {
  const auto all = orders();
  EXPECT_TRUE(shows_signs(all, 6));
  EXPECT_FALSE(shows_signs(all, 7));
  EXPECT_TRUE(shows_signs(std::vector{0.0, 0.125, 12.0}, 3));
  EXPECT_FALSE(shows_signs(std::vector{0.0, 0.2, 12.0}, 3));
}

/// A line over 0.1 to 0.9 in steps of 0.001, with heights and displacement as functions of Ω.
template <typename Height, typename Displacement>
LineSignature signs_of(Height height, Displacement displacement, double limit = 1e-3) {
  std::vector<double> speeds;
  std::vector<SignHeights> heights;
  std::vector<double> displacements;
  for (int i = 0; i <= 800; ++i) {
    speeds.push_back(0.1 + 0.001 * i);
    heights.push_back({height(speeds.back()), 0.0, 0.0});
    displacements.push_back(displacement(speeds.back()));
  }
  return find_signs({speeds, displacements, heights}, limit, SpeedScale(3));
}

TEST(Signature, AStepIsAnnouncedSoonAndTheLimitWhereItIsPassed) {
  const auto found = signs_of([](double speed) { return speed < 0.3405 ? 1e-5 : 1e-3; },
                              [](double speed) { return speed < 0.4005 ? 5e-4 : 2e-3; });
  EXPECT_NEAR(found.limit_speed_ratio, 0.401, 1e-9);
  // Of the 33 points of a stretch a fifth has to stand on a step of 100 for the mean to grow to 2.5.
  EXPECT_NEAR(found.signs[kPassing].speed_ratio, 0.347, 1e-9);
  EXPECT_NEAR(found.announced(), 0.347, 1e-9);
  EXPECT_EQ(found.signs[kPassing].false_signs, 0U);
  EXPECT_TRUE(std::isnan(found.signs[kSubharmonic].speed_ratio));
  EXPECT_TRUE(std::isnan(found.displacement.speed_ratio)) << "it steps where it passes the limit";
}

TEST(Signature, ASignThatIsWithdrawnBeforeTheLimitIsFalse) {
  const auto found = signs_of([](double speed) { return speed > 0.2 && speed < 0.25 ? 1e-4 : 1e-5; },
                              [](double speed) { return speed < 0.4005 ? 5e-4 : 2e-3; });
  EXPECT_TRUE(std::isnan(found.announced()));
  EXPECT_EQ(found.signs[kPassing].false_signs, 1U);
}

TEST(Signature, ASignOnALineThatKeepsTheLimitIsFalse) {
  const auto found =
      signs_of([](double speed) { return speed < 0.5 ? 1e-5 : 1e-3; }, [](double) { return 5e-4; });
  EXPECT_TRUE(std::isnan(found.limit_speed_ratio));
  EXPECT_TRUE(std::isnan(found.announced()));
  EXPECT_EQ(found.signs[kPassing].false_signs, 1U);
}

TEST(Signature, ASignThatStandsOnALineThatIsNotDoneIsNotYetFalse) {
  const auto height = [](double speed) { return speed < 0.5 ? 1e-5 : 1e-3; };
  EXPECT_TRUE(signs_of(height, [](double) { return 5e-4; }).is_kept);
  const auto found = signs_of(height, [](double speed) { return speed < 0.8 ? 5e-4 : kNotANumber; });
  EXPECT_FALSE(found.is_kept) << "the limit may be passed above 0.8";
  EXPECT_TRUE(std::isnan(found.limit_speed_ratio));
  EXPECT_TRUE(std::isnan(found.announced()));
  EXPECT_EQ(found.signs[kPassing].false_signs, 0U);
}

TEST(Signature, WhatGrowsBelowAThousandthOfTheLimitIsNotSeen) {
  const auto found = signs_of([](double speed) { return speed < 0.3 ? 1e-12 : 1e-6; },
                              [](double speed) { return speed < 0.4005 ? 5e-4 : 2e-3; });
  EXPECT_TRUE(std::isnan(found.announced()));
  EXPECT_EQ(found.signs[kPassing].false_signs, 0U);
}

TEST(Signature, TheForcedResponseOfALinearRotorIsNoSignBelowThreeQuartersOfTheNaturalFrequency) {
  const auto response = [](double speed) { return 1e-3 * speed * speed / (1.0 - speed * speed); };
  const auto found = signs_of(response, [](double speed) { return speed < 0.75 ? 0.0 : 1.0; });
  EXPECT_TRUE(std::isnan(found.announced()));
}

TEST(Signature, AMotionThatLeavesTheModelIsBeyondEveryLimitAndUnknownPointsAreLeftOut) {
  const auto found = signs_of(
      [](double speed) {
        if (speed > 0.28 && speed < 0.29) return kNotANumber;
        return speed < 0.3 ? 1e-5 : 1e-3;
      },
      [](double speed) {
        return speed > 0.5                    ? std::numeric_limits<double>::infinity()
               : speed > 0.28 && speed < 0.29 ? kNotANumber
                                              : 0.0;
      },
      1.0);
  EXPECT_NEAR(found.limit_speed_ratio, 0.5, 1.1e-3);
  EXPECT_TRUE(std::isnan(found.announced())) << "a line of a thousandth of the limit is not seen";
  EXPECT_EQ(found.limit, 1.0);
}

TEST(Signature, ALimitThatIsPassedBehindUnknownPointsMayBePassedEarlier) {
  const auto height = [](double speed) { return speed < 0.3 ? 1e-5 : 1e-3; };
  for (const double first : {0.0, 0.35}) {  // beyond the limit from the first point on, or behind a gap
    const auto found = signs_of(height, [&](double speed) {
      return speed < first ? 5e-4 : speed < 0.4005 && first > 0.0 ? kNotANumber : 2e-3;
    });
    EXPECT_NEAR(found.limit_speed_ratio, first > 0.0 ? 0.401 : 0.1, 1e-9);
    EXPECT_FALSE(found.passing_is_seen);
    EXPECT_TRUE(std::isnan(found.announced()));
    EXPECT_EQ(found.signs[kPassing].false_signs, 0U) << "the limit may be passed right above the sign";
  }
}

TEST(Signature, NoSignIsJudgedWhereNoTwoMeansAreKnownBelowTheLimit) {
  const auto displacement = [](double speed) { return speed < 0.4005 ? 5e-4 : 2e-3; };
  const auto flat = signs_of([](double) { return 1e-5; }, displacement);
  EXPECT_TRUE(flat.passing_is_seen);
  EXPECT_TRUE(flat.signs[kPassing].is_judged);
  const auto late = signs_of([](double speed) { return speed < 0.37 ? kNotANumber : 1e-5; }, displacement);
  EXPECT_TRUE(late.passing_is_seen);
  EXPECT_FALSE(late.signs[kPassing].is_judged);
}

TEST(DisplacementLimit, HasAUnitOrIsInClearances) {
  settings::Scene scene;
  EXPECT_NEAR(parse_limit("0.5 mm")->metres(scene), 5e-4, 1e-18);
  EXPECT_NEAR(parse_limit("20um")->metres(scene), 2e-5, 1e-18);
  EXPECT_NEAR(parse_limit("20 µm")->metres(scene), 2e-5, 1e-18);
  EXPECT_NEAR(parse_limit("1e-3 m")->metres(scene), 1e-3, 1e-18);
  EXPECT_NEAR(parse_limit("2 clearances")->metres(scene), 2.0 * scene.clearance(), 1e-18);
  EXPECT_NEAR(DisplacementLimit{}.metres(scene), 0.5 * scene.clearance(), 1e-18);
  for (const auto* wrong : {"", "mm", "0.5", "0.5 inch", "-1 mm", "0 mm", "nan mm", "inf m", "1 mm 2"})
    EXPECT_FALSE(parse_limit(wrong)) << wrong;
}

}  // namespace
}  // namespace rubatlas::analysis

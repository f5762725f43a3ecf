/// The solver's table of the elastica against the literal form, and its continuity.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "blade/elastica.hpp"
#include "blade/elastica_curve.hpp"
#include "legendre_form.hpp"
#include "reference_rows.hpp"
#include "sampling.hpp"

namespace rubatlas::blade {
namespace {

/// What the table promises, relative, up to a shortening of 0.6 L: for moderate and for any friction.
constexpr double kAccuracy = 1e-12;
constexpr double kAccuracyUpToOne = 1e-14;

double relative(double found, long double exact) {
  return std::abs(static_cast<double>((static_cast<long double>(found) - exact) / exact));
}

void expect_the_legendre_form(int count) {
  for (const double friction : frictions()) {
    const ElasticaCurve curve(friction);
    const double allowed = friction <= 1.0 ? kAccuracyUpToOne : kAccuracy;
    for (const double bending : bendings(friction, 0.6, count)) {
      const auto exact = legendre_form(friction, bending);
      const CurvePoint point = curve.at(bending);
      ASSERT_LE(relative(point.load, exact.load), allowed) << "friction " << friction << ", u " << bending;
      ASSERT_LE(relative(point.shortening, exact.shortening), allowed)
          << "friction " << friction << ", u " << bending;
      ASSERT_LE(relative(point.deflection, exact.deflection), allowed)
          << "friction " << friction << ", u " << bending;
    }
  }
}

TEST(ElasticaCurve, EqualsTheLegendreFormHoweverSmallTheLoad) {
  expect_the_legendre_form(10);
}
TEST(ElasticaCurveSlow, EqualsTheLegendreFormAtManyLoads) {
  expect_the_legendre_form(40);
}

TEST(ElasticaCurve, EqualsTheExactEquilibriumOnAFineGrid) {
  // Where the Legendre form would take minutes: the equilibrium, itself within 1e-17 of it.
  for (const double friction : frictions()) {
    const ElasticaCurve curve(friction);
    const double allowed = friction <= 1.0 ? kAccuracyUpToOne : kAccuracy;
    for (const double bending : bendings(friction, 0.6, 1500)) {
      const auto exact = equilibrium(friction, bending);
      const CurvePoint point = curve.at(bending);
      ASSERT_LE(relative(point.load, exact.load), allowed) << "friction " << friction << ", u " << bending;
      ASSERT_LE(relative(point.shortening, exact.shortening), allowed)
          << "friction " << friction << ", u " << bending;
      ASSERT_LE(relative(point.deflection, exact.deflection), allowed)
          << "friction " << friction << ", u " << bending;
    }
  }
}

TEST(ElasticaCurve, EqualsReferenceValuesAtGivenLoads) {
  int compared = 0;
  for (const ReferenceRow& row : reference_rows()) {
    if (row.shortening > 0.6) continue;
    const ElasticaCurve curve(row.friction);
    const CurvePoint point = curve.at(static_cast<double>(bending_at_load(row.friction, row.load)));
    EXPECT_LE(relative(point.load, row.load), kReferenceAccuracy) << row.friction << ", " << row.load;
    EXPECT_LE(relative(point.shortening, row.shortening), kReferenceAccuracy)
        << row.friction << ", " << row.load;
    EXPECT_LE(relative(point.deflection, row.deflection), kReferenceAccuracy)
        << row.friction << ", " << row.load;
    ++compared;
  }
  EXPECT_GT(compared, 50);
}

// Slopes are as good as values whose rounding is spread over a piece, a quarter octave of u: relative to the
// larger of the slope and value/u. (On the plateau at the Euler load, the load hardly changes, and its slope
// is next to nothing.)
constexpr double kSlopeAccuracy = 1e-12;

double slope_error(double found, long double exact, double value, double bending) {
  const double scale = std::max(std::abs(static_cast<double>(exact)), std::abs(value) / bending);
  return std::abs(static_cast<double>(found - exact)) / scale;
}

void expect_slopes_of_the_curve(int count) {
  for (const double friction : frictions()) {
    const ElasticaCurve curve(friction);
    for (const double bending : bendings(friction, 0.6, count)) {
      const auto exact = legendre_slopes(friction, bending);
      const CurvePoint point = curve.at(bending);
      ASSERT_LE(slope_error(point.load_slope, exact.load, point.load, bending), kSlopeAccuracy)
          << friction << ", u " << bending;
      ASSERT_LE(slope_error(point.shortening_slope, exact.shortening, point.shortening, bending),
                kSlopeAccuracy)
          << friction << ", u " << bending;
      ASSERT_LE(slope_error(point.deflection_slope, exact.deflection, point.deflection, bending),
                kSlopeAccuracy)
          << friction << ", u " << bending;
    }
  }
}

TEST(ElasticaCurve, SlopesAreTheDerivativesOfTheCurve) {
  expect_slopes_of_the_curve(5);
}
TEST(ElasticaCurveSlow, SlopesAreTheDerivativesOfTheCurveAtManyLoads) {
  expect_slopes_of_the_curve(10);
}

TEST(ElasticaCurve, StartsUnloadedOrAtTheEulerLoad) {
  for (const double friction : frictions()) {
    const CurvePoint start = ElasticaCurve(friction).at(0.0);
    const double euler = std::numbers::pi * std::numbers::pi / 4;
    EXPECT_NEAR(start.load, friction > 0.0 ? 0.0 : euler, friction > 0.0 ? 0.0 : 1e-15 * euler) << friction;
    EXPECT_EQ(start.shortening, 0.0);
    EXPECT_EQ(start.deflection, 0.0);
    EXPECT_EQ(start.load_slope, 0.0);
    EXPECT_EQ(start.shortening_slope, 0.0);
    EXPECT_NEAR(start.deflection_slope, friction > 0.0 ? 0.0 : 2 / std::numbers::pi,
                friction > 0.0 ? 0.0 : 1e-15);
  }
}

TEST(ElasticaCurve, IsContinuedByItsSymmetryBeyondTheUnloadedBlade) {
  for (const double friction : frictions()) {
    const ElasticaCurve curve(friction);
    const double parity = friction > 0.0 ? 1.0 : -1.0;  // a column bends to either side
    for (const double bending : bendings(friction, 0.6, 10)) {
      const CurvePoint right = curve.at(bending);
      const CurvePoint left = curve.at(-bending);
      EXPECT_EQ(left.load, right.load);
      EXPECT_EQ(left.shortening, right.shortening);
      EXPECT_EQ(left.deflection, parity * right.deflection);
      EXPECT_EQ(left.load_slope, -right.load_slope);
      EXPECT_EQ(left.shortening_slope, -right.shortening_slope);
      EXPECT_EQ(left.deflection_slope, -parity * right.deflection_slope);
    }
  }
}

TEST(ElasticaCurve, IsContinuousFromPieceToPiece) {
  for (const double friction : frictions()) {
    const ElasticaCurve curve(friction);
    // Both sides are within the table's accuracy of one analytic function.
    const double allowed = 2 * (friction <= 1.0 ? kAccuracyUpToOne : kAccuracy);
    for (const auto& knot : curve.knots()) {
      if (knot.bending == 0.0 || knot.bending >= curve.end() || knot.shortening > 0.6) continue;
      const CurvePoint before = curve.at(std::nextafter(knot.bending, 0.0));
      const CurvePoint after = curve.at(knot.bending);
      EXPECT_LE(relative(before.load, after.load), allowed) << friction << ", " << knot.bending;
      EXPECT_LE(relative(before.shortening, after.shortening), allowed) << friction << ", " << knot.bending;
      EXPECT_LE(relative(before.deflection, after.deflection), allowed) << friction << ", " << knot.bending;
      const double u = knot.bending;
      EXPECT_LE(slope_error(before.load_slope, after.load_slope, after.load, u), 2 * kSlopeAccuracy)
          << friction << ", " << u;
      EXPECT_LE(slope_error(before.shortening_slope, after.shortening_slope, after.shortening, u),
                2 * kSlopeAccuracy)
          << friction << ", " << u;
      EXPECT_LE(slope_error(before.deflection_slope, after.deflection_slope, after.deflection, u),
                2 * kSlopeAccuracy)
          << friction << ", " << u;
    }
  }
}

TEST(ElasticaCurve, KnotsAscendFromTheUnloadedBladeToTheEnd) {
  for (const double friction : frictions()) {
    const ElasticaCurve curve(friction);
    const auto& knots = curve.knots();
    ASSERT_GT(knots.size(), 10U);
    EXPECT_EQ(knots.front().bending, 0.0);
    EXPECT_EQ(knots.front().shortening, 0.0);
    EXPECT_EQ(knots.front().deflection, 0.0);
    EXPECT_EQ(knots.back().bending, curve.end());
    EXPECT_GE(knots.back().shortening, 0.75) << "the largest shortening that a scene may allow, and a margin";
    for (std::size_t i = 1; i < knots.size(); ++i) {
      EXPECT_GT(knots[i].bending, knots[i - 1].bending) << friction;
      EXPECT_GT(knots[i].shortening, knots[i - 1].shortening) << friction;
      const CurvePoint point = curve.at(knots[i].bending);
      EXPECT_NEAR(point.shortening / knots[i].shortening, 1.0, 1e-10) << friction << ", knot " << i;
      EXPECT_NEAR(point.deflection / knots[i].deflection, 1.0, 1e-10) << friction << ", knot " << i;
    }
  }
}

TEST(ElasticaCurve, VanishingFrictionIsTheColumn) {
  // Also across 1e-16, below which a blade is taken for a column.
  const ElasticaCurve column(0.0);
  for (const double friction : {1e-17, 0.99e-16, 1.01e-16, 1e-15, 1e-12, 1e-9}) {
    const ElasticaCurve curve(friction);
    for (const double bending : {0.05, 0.3, 1.0, 1.6}) {
      const CurvePoint found = curve.at(bending);
      const CurvePoint expected = column.at(bending);
      const double allowed = 20 * friction / bending + 2e-14;
      EXPECT_NEAR(found.load / expected.load, 1.0, allowed) << friction << ", " << bending;
      EXPECT_NEAR(found.shortening / expected.shortening, 1.0, allowed) << friction << ", " << bending;
      EXPECT_NEAR(found.deflection / expected.deflection, 1.0, allowed) << friction << ", " << bending;
    }
  }
}

}  // namespace
}  // namespace rubatlas::blade

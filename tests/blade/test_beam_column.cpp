/// The beam-column against its closed form, its limits and the elastica; axial compliance in the table.
#include "blade/beam_column.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <numbers>

#include "blade/elastica_curve.hpp"
#include "sampling.hpp"

namespace rubatlas::blade {
namespace {

using Digits100 = boost::multiprecision::cpp_bin_float_100;

struct ClosedForm {
  long double load, shortening, deflection;
  long double load_slope, shortening_slope, deflection_slope;  ///< by u
};

/// The closed form as printed, with its derivatives, in 100 digits: cancellation costs it up to 48 of them.
ClosedForm closed_form(double friction, double bending) {
  const Digits100 mu = friction;
  const Digits100 u = bending;
  const Digits100 lambda = friction == 0.0 ? Digits100(acos(Digits100(-1)) / 2) : Digits100(atan(u / mu));
  const Digits100 lambda_slope = mu / (mu * mu + u * u);
  const Digits100 ratio_slope = (lambda - u * lambda_slope) / (lambda * lambda);  // of u/λ
  const auto rounded = [](const Digits100& value) { return static_cast<long double>(value); };
  return {rounded(lambda * lambda),
          rounded(3 * mu * mu / 4 + u * u / 4 - 3 * mu * u / (4 * lambda)),
          rounded(u / lambda - mu),
          rounded(2 * lambda * lambda_slope),
          rounded(u / 2 - 3 * mu * ratio_slope / 4),
          rounded(ratio_slope)};
}

double relative(long double found, long double exact) {
  return static_cast<double>(std::abs(found - exact) / std::abs(exact));
}

/// As far as an elastica bends, which is far beyond small slopes.
std::vector<double> bent(double friction) {
  return bendings(friction, 0.6, 60);
}

TEST(BeamColumn, EqualsItsClosedFormHoweverSmallTheLoad) {
  for (const double friction : frictions()) {
    for (const double bending : bent(friction)) {
      const auto found = beam_column_equilibrium(friction, bending);
      const auto exact = closed_form(friction, bending);
      ASSERT_LE(relative(found.load, exact.load), 1e-18) << friction << ", " << bending;
      ASSERT_LE(relative(found.shortening, exact.shortening), 2e-18) << friction << ", " << bending;
      ASSERT_LE(relative(found.deflection, exact.deflection), 1e-18) << friction << ", " << bending;
    }
  }
}

TEST(BeamColumn, SatisfiesTheEquationOfItsDeflection) {
  // EI w'' = F(Δ − w) + μF(L − x) integrated by Simpson's double rule from the clamp: w(L) must come out as
  // Δ.
  for (const double friction : {0.0, 0.1, 1.0}) {
    for (const double bending : {0.05, 0.4, 1.0}) {
      const auto tip = beam_column_equilibrium(friction, bending);
      constexpr int kSteps = 2000;
      const long double step = 1.0L / kSteps;
      long double w = 0.0L;
      long double slope = 0.0L;
      long double shortening = 0.0L;
      const auto curvature = [&](long double at, long double deflection) {
        return tip.load * (tip.deflection - deflection + friction * (1.0L - at));
      };
      for (int i = 0; i < kSteps; ++i) {  // Runge–Kutta–Nyström of order 4
        const long double x = i * step;
        const long double k1 = curvature(x, w);
        const long double k2 = curvature(x + step / 2, w + step / 2 * slope + step * step / 8 * k1);
        const long double k3 = curvature(x + step, w + step * slope + step * step / 2 * k2);
        const long double middle = slope + step / 4 * (k1 + k2);
        const long double next = slope + step / 6 * (k1 + 4 * k2 + k3);
        shortening += step / 12 * (slope * slope + 4 * middle * middle + next * next);
        w += step * slope + step * step / 6 * (k1 + 2 * k2);
        slope = next;
      }
      EXPECT_NEAR(static_cast<double>(w / tip.deflection), 1.0, 1e-10) << friction << ", " << bending;
      EXPECT_NEAR(static_cast<double>(shortening / tip.shortening), 1.0, 1e-6) << friction << ", " << bending;
    }
  }
}

TEST(BeamColumn, BendsLikeALaterallyLoadedCantileverUnderSmallLoads) {
  for (const double friction : {0.01, 0.1, 1.0}) {
    const auto tip = beam_column_equilibrium(friction, 1e-6 * friction);
    EXPECT_NEAR(static_cast<double>(tip.deflection / (friction * tip.load / 3)), 1.0, 1e-11);
    EXPECT_NEAR(static_cast<double>(tip.shortening / (0.6L * tip.deflection * tip.deflection)), 1.0, 1e-11);
  }
}

TEST(BeamColumn, NeverPassesTheEulerLoad) {
  for (const double friction : {1e-3, 0.1, 1.0}) {
    double before = 0.0;
    for (const double bending : {0.1, 1.0, 10.0, 100.0}) {
      const double load = static_cast<double>(beam_column_equilibrium(friction, bending).load);
      EXPECT_GT(load, before);
      EXPECT_LT(load, kEulerLoad);
      before = load;
    }
  }
  for (const double bending : {1e-9, 0.1, 1.0}) {
    const auto column = beam_column_equilibrium(0.0L, bending);
    EXPECT_EQ(static_cast<double>(column.load), kEulerLoad);
    EXPECT_NEAR(static_cast<double>(column.deflection), 2 * bending / std::numbers::pi, 1e-16);
    EXPECT_NEAR(static_cast<double>(column.shortening), bending * bending / 4, 1e-16);
  }
}

TEST(BeamColumn, AgreesWithTheElasticaToSecondOrderInTheSlope) {
  // u and μ halved together: slopes halve, and the relative difference falls to a quarter.
  double before[3] = {0.0, 0.0, 0.0};
  for (const double part : {1.0, 0.5, 0.25, 0.125, 0.0625}) {
    const double friction = 0.2 * part;
    const double bending = 0.3 * part;
    const auto linear = beam_column_equilibrium(friction, bending);
    const auto bent = equilibrium(friction, bending);
    const double difference[3] = {relative(linear.load, bent.load),
                                  relative(linear.shortening, bent.shortening),
                                  relative(linear.deflection, bent.deflection)};
    for (int i = 0; i < 3; ++i) {
      if (before[i] > 0.0) {
        EXPECT_NEAR(std::log2(before[i] / difference[i]), 2.0, 0.05) << part << ", " << i;
      }
      before[i] = difference[i];
    }
  }
}

constexpr double kTableAccuracy = 1e-12;
constexpr double kTableAccuracyUpToOne = 1e-14;

TEST(BeamColumnCurve, EqualsTheClosedFormHoweverSmallTheLoad) {
  for (const double friction : frictions()) {
    const ElasticaCurve curve(friction, Theory::beam_column);
    const double allowed = friction <= 1.0 ? kTableAccuracyUpToOne : kTableAccuracy;
    for (const double bending : bent(friction)) {
      const auto exact = closed_form(friction, bending);
      const CurvePoint point = curve.at(bending);
      ASSERT_LE(relative(point.load, exact.load), allowed) << friction << ", " << bending;
      ASSERT_LE(relative(point.shortening, exact.shortening), allowed) << friction << ", " << bending;
      ASSERT_LE(relative(point.deflection, exact.deflection), allowed) << friction << ", " << bending;
    }
    EXPECT_GE(curve.knots().back().shortening, 0.75);
    EXPECT_EQ(curve.load_angle(), friction);
  }
}

TEST(BeamColumnCurve, SlopesAreTheDerivativesOfTheCurve) {
  const auto error = [](double found, long double exact, double value, double bending) {
    const double scale = std::max(std::abs(static_cast<double>(exact)), std::abs(value) / bending);
    return std::abs(static_cast<double>(found - exact)) / scale;
  };
  for (const double friction : frictions()) {
    const ElasticaCurve curve(friction, Theory::beam_column);
    for (const double bending : bent(friction)) {
      const auto exact = closed_form(friction, bending);
      const CurvePoint point = curve.at(bending);
      ASSERT_LE(error(point.load_slope, exact.load_slope, point.load, bending), 1e-12);
      ASSERT_LE(error(point.shortening_slope, exact.shortening_slope, point.shortening, bending), 1e-12);
      ASSERT_LE(error(point.deflection_slope, exact.deflection_slope, point.deflection, bending), 1e-12);
    }
  }
}

TEST(AxialCompliance, AddsItsShareOfTheLoadToTheShortening) {
  for (const Theory theory : {Theory::elastica, Theory::beam_column}) {
    for (const double friction : frictions()) {
      for (const double compliance : {1e-12, 1e-5, 1e-3}) {
        const ElasticaCurve curve(friction, theory, compliance);
        const double allowed = friction <= 1.0 ? kTableAccuracyUpToOne : kTableAccuracy;
        for (const double bending : bent(friction)) {
          const auto exact = theory == Theory::elastica ? equilibrium(friction, bending)
                                                        : beam_column_equilibrium(friction, bending);
          const CurvePoint point = curve.at(bending);
          ASSERT_LE(relative(point.shortening, exact.shortening + compliance * exact.load), allowed)
              << friction << ", " << compliance << ", " << bending;
          ASSERT_LE(relative(point.load, exact.load), allowed);
        }
      }
    }
  }
}

}  // namespace
}  // namespace rubatlas::blade

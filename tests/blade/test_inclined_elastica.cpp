/// The elastica under a load of any inclination, against the 80-bit one and against textbooks.
#include "blade/inclined_elastica.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <cmath>
#include <numbers>

#include "blade/elastica.hpp"

namespace rubatlas::blade {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(InclinedElastica, IsTheBladeOfTheModelWhereTheLoadBendsIt) {
  // u from next to nothing to a shortening of 0.75 L; b = atan μ.
  int compared = 0;
  double worst = 0.0;
  for (const double friction : {1e-6, 1e-3, 0.01, 0.1, 0.3, 0.5, 1.0, 2.0}) {
    const double beta = std::atan(friction);
    for (double bending = 1e-6; bending < 2.6; bending *= 1.3) {
      const auto exact = equilibrium(static_cast<long double>(friction), static_cast<long double>(bending));
      if (exact.shortening > 0.75L) break;
      // The chart's κ and φ, rounded; the exact blade at what they then are.
      const double tip = std::hypot(beta, bending);
      const double modulus = std::sin(tip / 2);
      const double amplitude =
          std::atan2(std::sqrt(std::sin((tip + beta) / 2) * std::sin(bending * (bending / (tip + beta)) / 2)),
                     std::sin(beta / 2));
      const InclinedPoint point = inclined_equilibrium({modulus, amplitude});
      const auto axial = static_cast<long double>(point.load.value) *
                         std::cos(std::atan(static_cast<long double>(friction)));
      const auto error = [&](long double value, long double reference) {
        return static_cast<double>(std::abs(value / reference - 1));
      };
      worst = std::max({worst, error(axial, exact.load), error(point.shortening.value, exact.shortening),
                        error(point.deflection.value, exact.deflection)});
      // Near the column, where sin(β/2)/κ is small, the load angle has the absolute accuracy of φ.
      ASSERT_NEAR(point.load_angle.value, beta, 4e-16);
      ++compared;
    }
  }
  EXPECT_GT(compared, 350);
  EXPECT_LT(worst, 5e-15);
}

TEST(InclinedElastica, BladesBentAgainstTheirLoadFollowLegendresIntegrals) {
  // φ > π/2: q = K + F(φ − π/2), and the means of cos ψ and sin ψ by MODEL 3.2, turned by b.
  using boost::math::ellint_1;
  using boost::math::ellint_2;
  for (const double modulus : {0.01, 0.1, 0.4, 0.7, 0.9, 0.98}) {
    for (double amplitude = 0.3; amplitude < 3.14; amplitude += 0.2) {
      const double rest = kPi / 2 - amplitude;  // χ0
      const double q = ellint_1(modulus) - ellint_1(modulus, rest);
      const double mean_cosine = (2 * (ellint_2(modulus) - ellint_2(modulus, rest)) - q) / q;
      const double mean_sine = 2 * modulus * std::sin(amplitude) / q;
      const double b = 2 * std::asin(modulus * std::cos(amplitude));
      const InclinedPoint point = inclined_equilibrium({modulus, amplitude});
      EXPECT_NEAR(point.load.value, q * q, 1e-14 * q * q);
      EXPECT_NEAR(point.load_angle.value, b, 1e-15);
      EXPECT_NEAR(point.shortening.value, 1 - (mean_cosine * std::cos(b) + mean_sine * std::sin(b)), 3e-15);
      EXPECT_NEAR(point.deflection.value, mean_sine * std::cos(b) - mean_cosine * std::sin(b), 3e-15);
      // Moment of the tip load about the clamp.
      EXPECT_NEAR(point.curvature,
                  point.load.value *
                      (std::cos(b) * point.deflection.value + std::sin(b) * (1 - point.shortening.value)),
                  2e-14 * point.load.value);
    }
  }
}

TEST(InclinedElastica, ColumnWhoseLoadPointsAtAFixedPoleBucklesLater) {
  // κ → 0 is the beam-column. A load that always points at a pole on the axis, a distance p behind the tip,
  // holds the column up: tan q / q = 1 − p/L, from the Euler load π²/4 (p infinite) to π² where the pole is
  // the clamp itself (Timoshenko, Gere, Theory of Elastic Stability, chapter 2).
  double before = kPi * kPi / 4;
  for (double amplitude = 1.6; amplitude < 3.13; amplitude += 0.1) {
    const InclinedPoint point = inclined_equilibrium({1e-6, amplitude});
    const double pole = point.deflection.value / -point.load_angle.value;  // p/L
    const double q = std::sqrt(point.load.value);
    EXPECT_NEAR(std::tan(q) / q, 1 - pole, 1e-9 * pole) << amplitude;
    EXPECT_GT(point.load.value, before);
    before = point.load.value;
  }
  EXPECT_NEAR(inclined_equilibrium({1e-6, kPi / 2}).load.value, kPi * kPi / 4, 1e-10);
  const InclinedPoint last = inclined_equilibrium({1e-6, 3.14});
  EXPECT_NEAR(last.load.value, kPi * kPi, 0.011);
  EXPECT_NEAR(last.deflection.value / -last.load_angle.value, 1.0, 1e-3);
}

TEST(InclinedElastica, SlopesAreTheDerivatives) {
  for (const double modulus : {-0.7, -0.05, 0.02, 0.3, 0.9}) {
    for (const double amplitude : {0.05, 0.7, 1.5, 1.6, 2.9}) {
      const auto difference = [](const auto& function, double step) {
        return (8 * (function(step) - function(-step)) - (function(2 * step) - function(-2 * step))) /
               (12 * step);
      };
      const InclinedPoint here = inclined_equilibrium({modulus, amplitude});
      for (const auto member : {&InclinedPoint::load, &InclinedPoint::load_angle, &InclinedPoint::shortening,
                                &InclinedPoint::deflection}) {
        const auto by_modulus = [&](double step) {
          return (inclined_equilibrium({modulus + step, amplitude}).*member).value;
        };
        const auto by_amplitude = [&](double step) {
          return (inclined_equilibrium({modulus, amplitude + step}).*member).value;
        };
        EXPECT_NEAR((here.*member).by_modulus, difference(by_modulus, 2e-4), 1e-8)
            << modulus << ", " << amplitude;
        EXPECT_NEAR((here.*member).by_amplitude, difference(by_amplitude, 2e-4), 1e-8)
            << modulus << ", " << amplitude;
      }
    }
  }
}

TEST(InclinedElastica, MirroredBladeHasTheMirroredShapeToTheLastBit) {
  for (const double amplitude : {1e-5, 0.5, 1.7, 3.0}) {
    const InclinedPoint one = inclined_equilibrium({0.3, amplitude});
    const InclinedPoint other = inclined_equilibrium({-0.3, amplitude});
    EXPECT_EQ(other.load.value, one.load.value);
    EXPECT_EQ(other.load_angle.value, -one.load_angle.value);
    EXPECT_EQ(other.shortening.value, one.shortening.value);
    EXPECT_EQ(other.deflection.value, -one.deflection.value);
  }
}

}  // namespace
}  // namespace rubatlas::blade

/// The exact equilibrium of a blade (MODEL 3.1, 3.2) against its literal form, reference values and limits.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "blade/elastica.hpp"
#include "legendre_form.hpp"
#include "reference_rows.hpp"
#include "sampling.hpp"

namespace rubatlas::blade {
namespace {

constexpr long double kEulerLoad = std::numbers::pi_v<long double> * std::numbers::pi_v<long double> / 4;

TEST(Elastica, EqualsTheLegendreFormHoweverSmallTheLoad) {
  // Gauss's rules in 80-bit arithmetic: what is left is a hundred roundings of 5e-20.
  constexpr long double kAccuracy = 1e-17L;
  for (const double friction : frictions()) {
    for (const double bending : bendings(friction, 0.6, 12)) {
      const auto exact = legendre_form(friction, bending);
      const auto found = equilibrium(friction, bending);
      ASSERT_LE(std::abs(found.load - exact.load), kAccuracy * exact.load) << friction << ", u " << bending;
      ASSERT_LE(std::abs(found.shortening - exact.shortening), kAccuracy * exact.shortening)
          << friction << ", u " << bending;
      ASSERT_LE(std::abs(found.deflection - exact.deflection), kAccuracy * exact.deflection)
          << friction << ", u " << bending;
    }
  }
}

TEST(Elastica, EqualsReferenceValuesAtGivenLoads) {
  for (const ReferenceRow& row : reference_rows()) {
    const long double bending = bending_at_load(row.friction, row.load);
    const auto found = equilibrium(row.friction, bending);
    EXPECT_NEAR(static_cast<double>(found.shortening / row.shortening), 1.0, kReferenceAccuracy)
        << "friction " << row.friction << ", load " << row.load;
    EXPECT_NEAR(static_cast<double>(found.deflection / row.deflection), 1.0, kReferenceAccuracy)
        << "friction " << row.friction << ", load " << row.load;
    const long double tip_psi = std::hypot(std::atan(static_cast<long double>(row.friction)), bending);
    EXPECT_NEAR(static_cast<double>(std::sin(tip_psi / 2) / row.kappa), 1.0, kReferenceAccuracy)
        << "friction " << row.friction << ", load " << row.load;
  }
}

TEST(Elastica, LightLoadBendsAStraightCantilever) {
  // Δ/L → μ f/3 and δ/L → (3/5)(Δ/L)²; what is left falls with the load itself.
  for (const double friction : {1e-6, 1e-3, 0.1, 0.5, 2.0}) {
    for (const double part : {1e-3, 1e-5, 1e-8}) {
      const auto found = equilibrium(friction, part * std::atan(static_cast<long double>(friction)));
      const auto allowed = 0.5 * static_cast<double>(found.load);
      ASSERT_LT(allowed, 1e-5);
      const long double deflection = friction * found.load / 3;
      EXPECT_NEAR(static_cast<double>(found.deflection / deflection), 1.0, allowed + 1e-16) << friction;
      const long double shortening = 0.6L * found.deflection * found.deflection;
      EXPECT_NEAR(static_cast<double>(found.shortening / shortening), 1.0, allowed + 1e-16) << friction;
    }
  }
}

TEST(Elastica, ColumnBucklesAtTheEulerLoad) {
  for (const long double bending : {1e-3L, 1e-6L, 1e-10L}) {
    const auto found = equilibrium(0.0L, bending);
    // f = K(sin(u/2))² = π²/4 (1 + u²/8 + …), Δ/L = 2 κ/K = 2u/π, δ/L = κ² = u²/4.
    EXPECT_LE(std::abs(found.load / kEulerLoad - 1 - bending * bending / 8), std::pow(bending, 4) + 1e-18L);
    EXPECT_LE(std::abs(found.deflection / (2 * bending / std::numbers::pi_v<long double>)-1),
              bending * bending + 1e-18L);
    EXPECT_LE(std::abs(found.shortening / (bending * bending / 4) - 1), bending * bending + 1e-18L);
  }
}

TEST(Elastica, ColumnAfterBucklingFollowsTheCompleteIntegrals) {
  // Up to u = 2, where the tip has come down by 0.8 L.
  for (double bending = 0.05; bending < 2.0; bending += 0.05) {
    const double kappa = std::sin(bending / 2);
    const double K = std::comp_ellint_1(kappa);
    const double E = std::comp_ellint_2(kappa);
    const auto found = equilibrium(0.0L, bending);
    EXPECT_NEAR(static_cast<double>(found.load), K * K, 1e-14 * K * K);
    EXPECT_NEAR(static_cast<double>(found.shortening), 2 * (1 - E / K), 1e-14);
    EXPECT_NEAR(static_cast<double>(found.deflection), 2 * kappa / K, 1e-14);
  }
}

TEST(Elastica, VanishingFrictionIsTheColumn) {
  // A bent column with a little side load: everything differs from the column by O(μ), at fixed tip angle.
  for (const double bending : {0.1, 0.5, 1.0, 2.0}) {
    const auto column = equilibrium(0.0L, bending);
    for (const double friction : {1e-4, 1e-6, 1e-8, 1e-12, 1e-15}) {
      const auto found = equilibrium(friction, bending);
      const auto allowed = static_cast<double>(20 * friction / bending + 1e-16);
      EXPECT_NEAR(static_cast<double>(found.load / column.load), 1.0, allowed) << bending << ", " << friction;
      EXPECT_NEAR(static_cast<double>(found.shortening / column.shortening), 1.0, allowed) << bending;
      EXPECT_NEAR(static_cast<double>(found.deflection / column.deflection), 1.0, allowed) << bending;
    }
  }
}

TEST(Elastica, LoadRisesWithTheBending) {
  for (const double friction : frictions()) {
    const double last = bending_at_shortening(friction, 0.75);
    long double before = friction > 0.0 ? 0.0L : kEulerLoad;
    long double lower = 0.0L;
    for (int i = 1; i <= 200; ++i) {
      const auto found = equilibrium(friction, last * i / 200);
      EXPECT_GT(found.load, before) << friction << ", " << i;
      EXPECT_GT(found.shortening, lower) << friction << ", " << i;
      before = found.load;
      lower = found.shortening;
    }
  }
}

}  // namespace
}  // namespace rubatlas::blade

/// A bent blade at eight nodes, and the functions in lanes that friction laws need.
#include "collocation/inclined_sweeps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "blade/inclined_elastica.hpp"

namespace rubatlas::collocation {
namespace {

using Number = Lanes<2>;

AtNodes stored(const Number& number) {
  AtNodes at;
  number.store(at);
  return at;
}

TEST(InclinedBladeInLanes, IsTheElasticaWithItsSlopes) {
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> modulus(1e-3, 0.8);
  std::uniform_real_distribution<double> amplitude(1e-3, 3.14);
  constexpr int kBlades = 2000;
  for (int blade = 0; blade < kBlades; ++blade) {
    const double kappa = modulus(generator);
    const double phi = amplitude(generator);
    const double u = kappa * std::sin(phi);
    const double lean = kappa * std::cos(phi);
    InclinedBlade<2> at;
    BladeRule rule;
    if (!at.set<true>(Number(u), Number(lean), rule)) continue;  // so long a rule is not kept
    const blade::InclinedPoint exact = blade::inclined_equilibrium({kappa, phi});
    const auto expect_same = [&](const InclinedBlade<2>::WithSlopes& found, const blade::Inclined& expected) {
      // The chart's slopes, from those by κ and φ.
      const double by_bending = (expected.by_modulus * u + expected.by_amplitude * lean / kappa) / kappa;
      const double by_lean = (expected.by_modulus * lean - expected.by_amplitude * u / kappa) / kappa;
      EXPECT_NEAR(stored(found.value)[0], expected.value, 2e-13 * (1.0 + std::abs(expected.value)));
      EXPECT_NEAR(stored(found.by_bending)[0], by_bending, 1e-10 * (1.0 + std::abs(by_bending)));
      EXPECT_NEAR(stored(found.by_lean)[0], by_lean, 1e-10 * (1.0 + std::abs(by_lean)));
    };
    SCOPED_TRACE(::testing::Message() << "κ " << kappa << ", φ " << phi);
    expect_same(at.load, exact.load);
    expect_same(at.shortening, exact.shortening);
    expect_same(at.deflection, exact.deflection);
    if (::testing::Test::HasFailure()) break;
  }
}

TEST(FunctionsInLanes, ErrByLessThanTwoFemto) {
  for (const double x : {0.0, 1e-300, 1e-9, 0.01, 0.3, 1.0, 3.0, 10.0, 19.0, 39.0, 41.0, 1e5}) {
    const double decay = -std::expm1(-x);
    EXPECT_NEAR(stored(contact::decayed(Number(x)))[0], decay, 2e-15 * decay) << x;
    for (const double sign : {-1.0, 1.0}) {
      const double exact = std::tanh(sign * x);
      EXPECT_NEAR(stored(contact::hyperbolic_tangent(Number(sign * x)))[0], exact, 2e-15 * std::abs(exact))
          << x;
    }
  }
}

}  // namespace
}  // namespace rubatlas::collocation

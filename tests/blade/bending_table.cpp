/// The blade over p = asinh(u/β), or over sqrt(u) without friction, is the blade.
#include "blade/bending_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "blade/elastica_curve.hpp"

namespace rubatlas::test {
namespace {

using blade::BendingTable;

std::array<double, 3> at(const BendingTable& table, double argument) {
  const int piece = std::clamp(static_cast<int>(argument / table.width()), 0, table.last_piece());
  const double t = argument / table.width() - piece;
  std::array<double, 3> sum{};
  const auto& coefficients = table.pieces()[piece].coefficients;
  for (std::size_t power = coefficients.size(); power-- > 0;) {
    for (std::size_t i = 0; i < 3; ++i) sum[i] = sum[i] * t + coefficients[power][i];
  }
  return sum;
}

TEST(BendingTable, AgreesWithTheElasticaAtEveryFriction) {
  for (const double friction : {0.0, 1e-6, 1e-3, 0.03, 0.1, 0.5, 0.8, 1.4, 2.0}) {
    const blade::ElasticaCurve curve(friction);
    const BendingTable& table = curve.over_asinh();
    EXPECT_GT(table.knots().back().shortening, 0.6);
    for (double p = 0.0; p < table.knots().back().argument; p += 0.0137) {
      SCOPED_TRACE(::testing::Message() << "friction " << friction << ", p " << p);
      const auto exact = curve.at(table.bending(p));
      const auto found = at(table, p);
      EXPECT_NEAR(found[0], exact.load, 3e-13 * (1.0 + exact.load));
      EXPECT_NEAR(found[1], exact.shortening, 3e-13);
      EXPECT_NEAR(found[2], exact.deflection, 3e-13);
    }
  }
}

TEST(BendingTable, KeepsTheDigitsOfABladeThatIsHardlyBent) {
  for (const double friction : {0.0, 1e-6, 1e-3, 0.03, 0.1, 0.5, 2.0}) {
    const blade::ElasticaCurve curve(friction);
    const BendingTable& table = curve.over_asinh();
    for (const double p : {0.05, 1e-3, 1e-5, 1e-7}) {
      SCOPED_TRACE(::testing::Message() << "friction " << friction << ", p " << p);
      const auto exact = curve.at(table.bending(p));
      const auto found = at(table, p);
      constexpr double kDigits = 1e-12;
      EXPECT_NEAR(found[0], exact.load, kDigits * exact.load);
      EXPECT_NEAR(found[1], exact.shortening, kDigits * exact.deflection) << "to which it is added";
      EXPECT_NEAR(found[2], exact.deflection, kDigits * exact.deflection);
    }
  }
}

}  // namespace
}  // namespace rubatlas::test

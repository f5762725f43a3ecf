/// The coefficients of the pair satisfy the conditions of its orders (Hairer, Nørsett, Wanner I, II.2 and
/// II.5).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>

#include "integrate/dormand_prince_853.hpp"

namespace rubatlas::integrate {
namespace {

using Table = DormandPrince853;

// Coefficients are rounded to double; those of size 40 leave up to 1e-14 in a sum.
constexpr double kRounding = 2e-14;

/// Nodes as the sums of the rows.
std::array<double, 16> nodes() {
  std::array<double, 16> result{};
  for (std::size_t i = 0; i < 16; ++i) {
    for (const double weight : Table::kStage[i]) result[i] += weight;
  }
  return result;
}

/// Σj a[i][j] c[j]^power
double row_moment(std::size_t i, int power) {
  const auto c = nodes();
  double sum = 0.0;
  for (std::size_t j = 0; j < 16; ++j) sum += Table::kStage[i][j] * std::pow(c[j], power);
  return sum;
}

TEST(DormandPrince853, RowsSumToThePublishedNodes) {
  const double root = std::sqrt(6.0);
  const std::array<double, 16> published = {0.0,
                                            (12 - 2 * root) / 135,
                                            (6 - root) / 45,
                                            (6 - root) / 30,
                                            (6 + root) / 30,
                                            1.0 / 3,
                                            1.0 / 4,
                                            4.0 / 13,
                                            127.0 / 195,
                                            3.0 / 5,
                                            6.0 / 7,
                                            1.0,
                                            1.0,
                                            1.0 / 10,
                                            1.0 / 5,
                                            7.0 / 9};
  const auto c = nodes();
  for (std::size_t i = 0; i < 16; ++i) EXPECT_NEAR(c[i], published[i], kRounding) << "stage " << i;
}

TEST(DormandPrince853, StagesUseOnlyWhatIsKnown) {
  for (std::size_t i = 0; i < 16; ++i) {
    for (std::size_t j = i; j < 16; ++j) EXPECT_EQ(Table::kStage[i][j], 0.0) << i << ", " << j;
  }
}

TEST(DormandPrince853, LastStageStandsAtTheEndOfTheStep) {
  for (std::size_t j = 0; j < 12; ++j) EXPECT_EQ(Table::kStage[12][j], Table::kWeight[j]) << j;
}

TEST(DormandPrince853, WeightsIntegratePolynomialsToOrderEight) {
  const auto c = nodes();
  for (int power = 0; power < 8; ++power) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 12; ++i) sum += Table::kWeight[i] * std::pow(c[i], power);
    EXPECT_NEAR(sum, 1.0 / (power + 1), kRounding) << power;
  }
  double ninth = 0.0;
  for (std::size_t i = 0; i < 12; ++i) ninth += Table::kWeight[i] * std::pow(c[i], 8);
  EXPECT_GT(std::abs(ninth - 1.0 / 9), 1e-7) << "order 8, not 9";
}

TEST(DormandPrince853, NestedIntegralsHoldToOrderEight) {
  // Trees with one branching: Σ bi ci^p Σ aij cj^q = 1 / ((q + 1)(p + q + 2)).
  const auto c = nodes();
  for (int p = 0; p <= 6; ++p) {
    for (int q = 0; p + q + 2 <= 8; ++q) {
      double sum = 0.0;
      for (std::size_t i = 0; i < 12; ++i) sum += Table::kWeight[i] * std::pow(c[i], p) * row_moment(i, q);
      EXPECT_NEAR(sum, 1.0 / ((q + 1) * (p + q + 2)), kRounding) << p << ", " << q;
    }
  }
}

TEST(DormandPrince853, DeepTreesHoldToOrderEight) {
  // Chains: b A^k c^q = q! / (q + k + 1)!.
  for (int depth = 1; depth <= 6; ++depth) {
    for (int q = 1; q + depth + 1 <= 8; ++q) {
      const auto c = nodes();
      std::array<double, 12> value{};
      for (std::size_t i = 0; i < 12; ++i) value[i] = std::pow(c[i], q);
      for (int k = 0; k < depth; ++k) {
        std::array<double, 12> next{};
        for (std::size_t i = 0; i < 12; ++i) {
          for (std::size_t j = 0; j < i; ++j) next[i] += Table::kStage[i][j] * value[j];
        }
        value = next;
      }
      double sum = 0.0;
      for (std::size_t i = 0; i < 12; ++i) sum += Table::kWeight[i] * value[i];
      EXPECT_NEAR(sum, std::tgamma(q + 1.0) / std::tgamma(q + depth + 2.0), kRounding) << depth << ", " << q;
    }
  }
}

TEST(DormandPrince853, EmbeddedSolutionsAreOfOrderThreeAndFive) {
  // Differences to a solution of order p vanish on polynomials of degree p − 1, and not on the next.
  const auto c = nodes();
  const auto moment = [&](const std::array<double, 13>& error, int power) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 13; ++i) sum += error[i] * std::pow(c[i], power);
    return sum;
  };
  for (int power = 0; power < 3; ++power) EXPECT_NEAR(moment(Table::kError3, power), 0.0, kRounding) << power;
  for (int power = 0; power < 5; ++power) EXPECT_NEAR(moment(Table::kError5, power), 0.0, kRounding) << power;
  EXPECT_GT(std::abs(moment(Table::kError3, 3)), 1e-3);
  EXPECT_GT(std::abs(moment(Table::kError5, 5)), 1e-4);
}

TEST(DormandPrince853, DenseOutputIntegratesPolynomialsToOrderSeven) {
  // y' = τ^k over one step [0, 1] from 0: the interpolant is θ^(k+1)/(k+1) throughout.
  const auto c = nodes();
  for (int power = 0; power < 7; ++power) {
    std::array<double, 7> d{};
    const double end = 1.0 / (power + 1);
    d[0] = end;
    d[1] = (power == 0 ? 1.0 : 0.0) - end;
    d[2] = 2 * end - (power == 0 ? 2.0 : 1.0);
    for (std::size_t row = 0; row < 4; ++row) {
      for (std::size_t i = 0; i < 16; ++i) d[row + 3] += Table::kDense[row][i] * std::pow(c[i], power);
    }
    for (double theta = 0.0; theta <= 1.0; theta += 0.0625) {
      const double rest = 1 - theta;
      const double value =
          theta *
          (d[0] +
           rest * (d[1] + theta * (d[2] + rest * (d[3] + theta * (d[4] + rest * (d[5] + theta * d[6]))))));
      EXPECT_NEAR(value, std::pow(theta, power + 1) / (power + 1), 1e-12) << power << ", " << theta;
    }
  }
}

}  // namespace
}  // namespace rubatlas::integrate

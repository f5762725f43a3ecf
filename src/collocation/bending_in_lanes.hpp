/// The table of a blade under an axial load, read at eight nodes at once.
#pragma once

#include <array>
#include <cstddef>

#include "blade/bending_table.hpp"
#include "collocation/nodes.hpp"
#include "collocation/nodes_in_lanes.hpp"

namespace rubatlas::collocation {
namespace {

template <std::size_t kWidth>
class BendingInLanes {
 public:
  using Number = Lanes<kWidth>;

  /// Load, shortening and deflection of the blade at eight nodes.
  struct Bend {
    Number load, shortening, deflection;
  };

  /// At p. With `kSlopes` the slopes by p, too, in units of a piece of the table, of the powers up to
  /// `kSlopeDegree`: they are for Newton's steps only, and four nodes are as many as registers hold at a
  /// time.
  template <bool kSlopes>
  static Bend curve(const blade::BendingTable& table, const Number& argument, Bend& slope) {
    const double per_argument = 1.0 / table.width();
    const Number place = argument * per_argument;
    const Number piece =
        whole(smaller(larger(place, Number(0.0)), Number(static_cast<double>(table.last_piece()))));
    // Not set to zero first. NOLINTNEXTLINE(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)
    alignas(64) double pieces[kNodes];
    // NOLINTNEXTLINE(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)
    alignas(64) double t[kNodes];
    piece.store_to(pieces);
    (place - piece).store_to(t);
    std::array<const double*, kNodes> coefficients;
    for (std::size_t k = 0; k < kNodes; ++k)
      coefficients[k] = table.pieces()[static_cast<int>(pieces[k])].coefficients[0].data();
    constexpr std::size_t kAtOnce = kSlopes ? 4 : kNodes;
    Rows sum, rate;
    for (std::size_t i = 0; i < kNodes; i += kAtOnce) {
      for (std::size_t k = i; k < i + kAtOnce; ++k) {
        for (std::size_t r = 0; r < kRows; ++r)
          sum[k][r] = row(coefficients[k], blade::BendingTable::kDegree, r);
      }
#pragma GCC unroll 16
      for (std::size_t below = 1; below <= blade::BendingTable::kDegree; ++below) {
        const std::size_t power = blade::BendingTable::kDegree - below;
        for (std::size_t k = i; k < i + kAtOnce; ++k) {
          for (std::size_t r = 0; r < kRows; ++r) {
            if (kSlopes && power + 1 == kSlopeDegree) rate[k][r] = sum[k][r];
            if (kSlopes && power + 1 < kSlopeDegree) rate[k][r] = rate[k][r] * t[k] + sum[k][r];
            sum[k][r] = sum[k][r] * t[k] + row(coefficients[k], power, r);
          }
        }
      }
    }
    if (kSlopes) slope = across(rate);
    return across(sum);
  }

 private:
  static constexpr std::size_t kSlopeDegree = 5;

  /// Each node has its own piece, of which one register holds all three quantities.
  static constexpr std::size_t kRowWidth = kWidth == 2 ? 2 : 4;
  using Row = typename Lanes<kRowWidth>::Part;
  static constexpr std::size_t kRows = 4 / kRowWidth;
  using Rows = std::array<std::array<Row, kRows>, kNodes>;

  static Row row(const double* coefficients, std::size_t power, std::size_t part) {
    return loaded_part<kRowWidth>(coefficients + 4 * power + part * kRowWidth);
  }
  static Bend across(const Rows& rows) {
    if constexpr (kWidth == 4) {
      // Two rows, of which each has two quantities of two nodes, make one of four nodes.
      Bend bend;
      for (std::size_t part = 0; part < Number::kParts; ++part) {
        const auto* const row = &rows[part * kWidth];
        const Row even_of_first = __builtin_shufflevector(row[0][0], row[1][0], 0, 4, 2, 6);
        const Row even_of_last = __builtin_shufflevector(row[2][0], row[3][0], 0, 4, 2, 6);
        const Row odd_of_first = __builtin_shufflevector(row[0][0], row[1][0], 1, 5, 3, 7);
        const Row odd_of_last = __builtin_shufflevector(row[2][0], row[3][0], 1, 5, 3, 7);
        bend.load.part(part) = __builtin_shufflevector(even_of_first, even_of_last, 0, 1, 4, 5);
        bend.shortening.part(part) = __builtin_shufflevector(odd_of_first, odd_of_last, 0, 1, 4, 5);
        bend.deflection.part(part) = __builtin_shufflevector(even_of_first, even_of_last, 2, 3, 6, 7);
      }
      return bend;
    }
    const auto quantity = [&](std::size_t q) {
      return Number::each([&](std::size_t k) { return rows[k][q / kRowWidth][q % kRowWidth]; });
    };
    return {quantity(0), quantity(1), quantity(2)};
  }
};

}  // namespace
}  // namespace rubatlas::collocation

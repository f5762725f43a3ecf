/// An explicit Runge–Kutta method as data: what a step asks of a table of coefficients
/// (`dormand_prince_853.hpp` and the like).
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace rubatlas::integrate {

/// Rows of weights, one after the other.
class WeightRows {
 public:
  constexpr WeightRows() = default;
  template <std::size_t kWidth, std::size_t kRows>
  explicit constexpr WeightRows(const std::array<std::array<double, kWidth>, kRows>& rows)
      : first_(rows.empty() ? nullptr : rows.front().data()), width_(kWidth), size_(kRows) {}
  [[nodiscard]] constexpr std::size_t size() const { return size_; }
  [[nodiscard]] constexpr std::span<const double> operator[](std::size_t row) const {
    return {first_ + row * width_, width_};
  }

 private:
  const double* first_ = nullptr;
  std::size_t width_ = 0;
  std::size_t size_ = 0;
};

struct Tableau {
  // Of any method.
  static constexpr std::size_t kMostStages = 16;
  static constexpr std::size_t kMostUpper = 4;
  static constexpr std::size_t kMostErrors = 2;

  int order;
  std::size_t stages;              ///< of a step; the row after them evaluates its end
  WeightRows stage;                ///< with those of dense output
  std::span<const double> weight;  ///< of the solution
  WeightRows upper;                ///< coefficients of dense output above those of the cubic
  WeightRows errors{};             ///< differences to the embedded solutions; none: it does not estimate
  /// The local error, from the norms of these differences; how much it exceeds that of the solution.
  double (*estimate)(std::span<const double> norms) = nullptr;
  double estimate_excess = 1.0;
};

template <class Table>
constexpr Tableau tableau() {
  static_assert(Table::kStage.size() <= Tableau::kMostStages && Table::kDense.size() <= Tableau::kMostUpper);
  Tableau result{Table::kOrder, Table::kStages, WeightRows(Table::kStage), Table::kWeight,
                 WeightRows(Table::kDense)};
  if constexpr (requires { Table::kErrors; }) {
    static_assert(Table::kErrors.size() <= Tableau::kMostErrors);
    result.errors = WeightRows(Table::kErrors);
    result.estimate = Table::estimate;
    result.estimate_excess = Table::kEstimateExcess;
  }
  return result;
}

}  // namespace rubatlas::integrate

#include "blade/bending_table.hpp"

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "blade/elastica_curve.hpp"
#include "integrate/decompositions.hpp"

namespace rubatlas::blade {
namespace {

/// Of L: the largest limit of validity that a scene may set.
constexpr double kLargestLimit = 0.6;
/// Of a piece at its end, in units of its numbers.
constexpr double kLargestError = 2e-13;

using Row = Eigen::RowVector3d;
Row row_of(const CurvePoint& at) {
  return {at.load, at.shortening, at.deflection};
}

template <int kCount>
using Rows = Eigen::Matrix<double, kCount, 3>;

/// Coefficients of powers from values at Chebyshev's points in [0, 1]: sums of large terms, for which
/// `double` has too few digits.
template <int kCount, class Value>
Rows<kCount> fit(const Value& value_at) {
  integrate::LongMatrix powers(kCount, kCount);
  integrate::LongMatrix values(kCount, 3);
  for (int i = 0; i < kCount; ++i) {
    const double point = 0.5 * (1.0 + std::cos(std::numbers::pi * (i + 0.5) / kCount));
    powers(i, 0) = 1;
    for (int k = 1; k < kCount; ++k) powers(i, k) = powers(i, k - 1) * point;
    const Row value = value_at(point);
    values.row(i) = value.cast<long double>();
  }
  return integrate::solve_long(powers, values).template cast<double>();
}

constexpr int kCount = static_cast<int>(BendingTable::kDegree) + 1;

/// Of the piece that starts at p.
Rows<kCount> later_piece(const BendingTable& table, const ElasticaCurve& curve, double start) {
  return fit<kCount>(
      [&](double part) { return row_of(curve.at(table.bending(start + table.width() * part))); });
}

/// From p = 0 all three are even functions of p. What they grow by from there keeps its digits however little
/// the blade is bent.
Rows<kCount> first_piece(const BendingTable& table, const ElasticaCurve& curve) {
  constexpr int kPowers = 5;  // of t²: the nearest singularities are at p = ±iπ/2
  const Row unbent = row_of(curve.at(0.0));
  const Rows<kPowers> fitted = fit<kPowers>([&](double square) -> Row {
    return (row_of(curve.at(table.bending(table.width() * std::sqrt(square)))) - unbent) / square;
  });
  Rows<kCount> result = Rows<kCount>::Zero();
  result.row(0) = unbent;
  for (int k = 0; k < kPowers; ++k) result.row(2 * k + 2) = fitted.row(k);
  return result;
}

}  // namespace

BendingTable::BendingTable(const ElasticaCurve& curve) : scale_(curve.load_angle()) {
  while (!fill(curve)) width_ *= 0.5;
}

bool BendingTable::fill(const ElasticaCurve& curve) {
  pieces_.clear();
  knots_.clear();
  while (knots_.empty() || knots_.back().shortening <= kLargestLimit) {
    const double start = static_cast<double>(pieces_.size()) * width_;
    const double end = start + width_;
    if (bending(end) > curve.end()) return false;
    const CurvePoint at_end = curve.at(bending(end));
    const Rows<kCount> fitted =
        pieces_.empty() ? first_piece(*this, curve) : later_piece(*this, curve, start);
    const Eigen::Array3d exact = row_of(at_end);
    if (((fitted.colwise().sum().transpose().array() - exact).abs() > kLargestError * (1.0 + exact)).any())
      return false;
    Piece& made = pieces_.emplace_back();
    for (std::size_t k = 0; k <= kDegree; ++k) {
      const Row of_power = fitted.row(static_cast<Eigen::Index>(k));
      made.coefficients[k] = {of_power[0], of_power[1], of_power[2], 0.0};
    }
    knots_.push_back({end, at_end.load, at_end.shortening, at_end.deflection});
  }
  return true;
}

}  // namespace rubatlas::blade

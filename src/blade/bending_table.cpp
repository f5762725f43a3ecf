#include "blade/bending_table.hpp"

#include <Eigen/LU>
#include <numbers>

#include "blade/elastica_curve.hpp"

namespace rubatlas::blade {
namespace {

/// Of L: the largest limit of validity that a scene may set. Not far beyond is the next singularity of the
/// curve.
constexpr double kLargestLimit = 0.6;

constexpr auto kCount = static_cast<Eigen::Index>(BendingTable::kDegree + 1);
using Points = Eigen::Matrix<double, kCount, 1>;
using Fit = Eigen::Matrix<double, kCount, kCount>;

const Points& chebyshev_points() {
  static const Points kPoints = [] {
    Points points;
    for (Eigen::Index i = 0; i < kCount; ++i)
      points[i] = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(kCount));
    return points;
  }();
  return kPoints;
}

/// Maps values at the Chebyshev points to coefficients of powers.
const Fit& fit() {
  static const Fit kFit = [] {
    Eigen::Matrix<long double, kCount, kCount> powers;
    powers.col(0).setOnes();
    for (Eigen::Index k = 1; k < kCount; ++k)
      powers.col(k) = powers.col(k - 1).cwiseProduct(chebyshev_points().cast<long double>());
    return Fit(powers.fullPivLu().inverse().cast<double>());
  }();
  return kFit;
}

}  // namespace

BendingTable::BendingTable(const ElasticaCurve& curve) : scale_(curve.load_angle()) {
  for (int piece = 0;; ++piece) {
    const double end = (piece + 1) * kWidth;
    const CurvePoint at_end = curve.at(bending(end));
    if (bending(end) > curve.end()) break;
    const double centre = (piece + 0.5) * kWidth;
    Eigen::Matrix<double, kCount, 3> samples;
    for (Eigen::Index i = 0; i < kCount; ++i) {
      const CurvePoint at = curve.at(bending(centre + 0.5 * kWidth * chebyshev_points()[i]));
      samples.row(i) << at.load, at.shortening, at.deflection;
    }
    const Eigen::Matrix<double, kCount, 3> fitted = fit() * samples;
    Piece& made = pieces_.emplace_back();
    for (Eigen::Index k = 0; k < kCount; ++k)
      made.coefficients[static_cast<std::size_t>(k)] = {fitted(k, 0), fitted(k, 1), fitted(k, 2), 0.0};
    knots_.push_back({end, at_end.load, at_end.shortening, at_end.deflection});
    if (at_end.shortening > kLargestLimit) break;
  }
}

}  // namespace rubatlas::blade

#include "blade/elastica_curve.hpp"

#include <numbers>

#include "blade/beam_column.hpp"
#include "blade/bending_table.hpp"
#include "blade/elastica.hpp"
#include "integrate/decompositions.hpp"

namespace rubatlas::blade {
namespace {

using Real = long double;
using Matrix = integrate::LongMatrix;

constexpr double kSmallestFriction = 1e-16;  ///< below it the blade is the column μ = 0 to the last bit
constexpr double kLargestShortening = 0.8;   ///< of L: a margin over the largest limit that a scene may set

/// Chebyshev points of (-1, 1).
Real chebyshev_point(int i, int count) {
  return std::cos(std::numbers::pi_v<Real> * (static_cast<Real>(i) + 0.5L) / static_cast<Real>(count));
}

/// Maps values at the Chebyshev points to coefficients of powers of the argument, which is `scale(point)`.
template <class Scale>
Matrix interpolation(int count, Scale scale) {
  Matrix powers(count, count);
  for (int i = 0; i < count; ++i) {
    const Real argument = scale(chebyshev_point(i, count));
    powers(i, 0) = 1;
    for (int k = 1; k < count; ++k) powers(i, k) = powers(i, k - 1) * argument;
  }
  return integrate::solve_long(powers, Matrix::Identity(count, count));
}

}  // namespace

ElasticaCurve::ElasticaCurve(double friction, Theory theory, double axial_compliance)
    : friction_(friction < kSmallestFriction ? 0.0 : friction),
      theory_(theory),
      axial_compliance_(axial_compliance),
      load_angle_(theory == Theory::elastica ? std::atan(friction_) : friction_),
      mirror_(friction_ == 0.0 ? -1.0 : 1.0) {
  // A power of two at most β/32, so that the first piece ends where a quarter octave begins.
  const double width = friction_ == 0.0 ? 0.125 : std::exp2(std::floor(std::log2(load_angle_ / 32.0)));
  const auto shifted_bits = [](double bending, int shift) {
    return static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(bending) >> shift);
  };
  coarse_origin_ = shifted_bits(width, kCoarseShift) - 1;
  fine_origin_ = shifted_bits(1.0, kFineShift) - (shifted_bits(1.0, kCoarseShift) - coarse_origin_);
  const double start = friction_ == 0.0 ? kEulerLoad : 0.0;
  knots_.push_back({{start, axial_compliance_ * start, 0.0, 1.0, 0.0, 0.0}, 0.0});
  add_first_piece(width);
  double from = width;
  while (knots_.back().shortening < kLargestShortening) {
    // One more unit in the last bit that the index keeps, carried into the exponent where it overflows.
    const int shift = from < 1.0 ? kCoarseShift : kFineShift;
    const auto to = std::bit_cast<double>(std::bit_cast<std::uint64_t>(from) + (std::uint64_t{1} << shift));
    add_piece(from, to);
    from = to;
  }
  last_piece_ = static_cast<std::int64_t>(pieces_.size()) - 1;
  end_ = knots_.back().bending;
  add_slopes();
  over_asinh_ = std::make_shared<BendingTable>(*this);
}

void ElasticaCurve::add_slopes() {
  for (Knot& knot : knots_) {
    const CurvePoint there = at(knot.bending);
    if (friction_ == 0.0) {
      knot.load_slope = there.load_slope;
      knot.shortening_slope = there.shortening_slope;
      knot.deflection_slope = there.deflection_slope;
    } else if (knot.bending == 0.0) {
      knot.shortening_slope = axial_compliance_;
      knot.deflection_slope = friction_ / 3.0;
    } else {
      knot.shortening_slope = there.shortening_slope / there.load_slope;
      knot.deflection_slope = there.deflection_slope / there.load_slope;
    }
  }
}

Equilibrium<long double> ElasticaCurve::exact(long double bending) const {
  return theory_ == Theory::elastica ? equilibrium(friction_, bending)
                                     : beam_column_equilibrium(friction_, bending);
}

void ElasticaCurve::add_knot(double bending) {
  const auto there = exact(bending);
  knots_.push_back({{static_cast<double>(there.load),
                     static_cast<double>(there.shortening + axial_compliance_ * there.load),
                     static_cast<double>(there.deflection), 1.0, 0.0, 0.0},
                    bending});
}

void ElasticaCurve::add_first_piece(double width) {
  // In t = u/width, with the exact leading powers t^lead and even steps: polynomials in t² over [0, 1].
  const std::array<int, 3> lead =
      friction_ == 0.0 ? std::array<int, 3>{0, 2, 1} : std::array<int, 3>{2, 4, 2};
  Piece piece{0.0, 1.0 / width, {}};
  piece.coefficients.fill(Eigen::Array4d::Zero());
  for (std::size_t component = 0; component < 3; ++component) {
    const int count = (kDegree - lead[component]) / 2 + 1;
    const auto square = [](Real point) { return (1 + point) / 2; };
    Eigen::Matrix<Real, Eigen::Dynamic, 1> samples(count);
    for (int i = 0; i < count; ++i) {
      const Real t = std::sqrt(square(chebyshev_point(i, count)));
      const auto there = exact(t * width);
      const std::array<Real, 3> value = {there.load, there.shortening, there.deflection};
      samples(i) = value[component] / std::pow(t, static_cast<Real>(lead[component]));
    }
    const Eigen::Matrix<Real, Eigen::Dynamic, 1> fitted = interpolation(count, square) * samples;
    auto power = static_cast<std::size_t>(lead[component]);
    for (const Real coefficient : fitted) {
      piece.coefficients[power][static_cast<Eigen::Index>(component)] = static_cast<double>(coefficient);
      power += 2;
    }
  }
  // Each with its own leading power, so that neither loses digits to the other.
  for (Eigen::Array4d& coefficient : piece.coefficients) coefficient[1] += axial_compliance_ * coefficient[0];
  pieces_.push_back(piece);
  add_knot(width);
}

void ElasticaCurve::add_piece(double from, double to) {
  static const Matrix kFit = interpolation(kDegree + 1, [](Real point) { return point; });
  const Real centre = (static_cast<Real>(from) + to) / 2;
  const Real half_width = (static_cast<Real>(to) - from) / 2;
  Matrix samples(kDegree + 1, 3);
  for (int i = 0; i <= kDegree; ++i) {
    const auto there = exact(centre + half_width * chebyshev_point(i, kDegree + 1));
    samples.row(i) << there.load, there.shortening + axial_compliance_ * there.load, there.deflection;
  }
  const Matrix fitted = kFit * samples;
  Piece piece{static_cast<double>(centre), static_cast<double>(1 / half_width), {}};
  for (int k = 0; k <= kDegree; ++k) {
    piece.coefficients[static_cast<std::size_t>(k)] << static_cast<double>(fitted(k, 0)),
        static_cast<double>(fitted(k, 1)), static_cast<double>(fitted(k, 2)), 0.0;
  }
  pieces_.push_back(piece);
  add_knot(to);
}

}  // namespace rubatlas::blade

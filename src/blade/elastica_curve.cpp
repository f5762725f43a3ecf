#include "blade/elastica_curve.hpp"

#include <Eigen/LU>
#include <numbers>

#include "blade/elastica.hpp"

namespace rubatlas::blade {
namespace {

using Real = long double;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

constexpr double kSmallestFriction = 1e-16;  ///< below it the blade is the column μ = 0 to the last bit
constexpr double kLargestShortening = 0.75;  ///< of L: a margin over the largest limit that a scene may set

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
  return powers.fullPivLu().inverse();
}

}  // namespace

ElasticaCurve::ElasticaCurve(double friction)
    : friction_(friction < kSmallestFriction ? 0.0 : friction),
      load_angle_(std::atan(friction_)),
      mirror_(friction_ == 0.0 ? -1.0 : 1.0) {
  // A power of two at most β/32, so that the first piece ends where a quarter octave begins.
  const double width = friction_ == 0.0 ? 0.125 : std::exp2(std::floor(std::log2(load_angle_ / 32.0)));
  const auto shifted_bits = [](double bending, int shift) {
    return static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(bending) >> shift);
  };
  coarse_origin_ = shifted_bits(width, kCoarseShift) - 1;
  fine_origin_ = shifted_bits(1.0, kFineShift) - (shifted_bits(1.0, kCoarseShift) - coarse_origin_);
  knots_.push_back({0.0, 0.0, 0.0});
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
      const auto exact = equilibrium(friction_, t * width);
      const std::array<Real, 3> value = {exact.load, exact.shortening, exact.deflection};
      samples(i) = value[component] / std::pow(t, static_cast<Real>(lead[component]));
    }
    const Eigen::Matrix<Real, Eigen::Dynamic, 1> fitted = interpolation(count, square) * samples;
    auto power = static_cast<std::size_t>(lead[component]);
    for (const Real coefficient : fitted) {
      piece.coefficients[power][static_cast<Eigen::Index>(component)] = static_cast<double>(coefficient);
      power += 2;
    }
  }
  pieces_.push_back(piece);
  const auto exact = equilibrium(friction_, width);
  knots_.push_back({width, static_cast<double>(exact.shortening), static_cast<double>(exact.deflection)});
}

void ElasticaCurve::add_piece(double from, double to) {
  static const Matrix kFit = interpolation(kDegree + 1, [](Real point) { return point; });
  const Real centre = (static_cast<Real>(from) + to) / 2;
  const Real half_width = (static_cast<Real>(to) - from) / 2;
  Matrix samples(kDegree + 1, 3);
  for (int i = 0; i <= kDegree; ++i) {
    const auto exact = equilibrium(friction_, centre + half_width * chebyshev_point(i, kDegree + 1));
    samples.row(i) << exact.load, exact.shortening, exact.deflection;
  }
  const Matrix fitted = kFit * samples;
  Piece piece{static_cast<double>(centre), static_cast<double>(1 / half_width), {}};
  for (int k = 0; k <= kDegree; ++k) {
    piece.coefficients[static_cast<std::size_t>(k)] << static_cast<double>(fitted(k, 0)),
        static_cast<double>(fitted(k, 1)), static_cast<double>(fitted(k, 2)), 0.0;
  }
  pieces_.push_back(piece);
  const auto exact = equilibrium(friction_, to);
  knots_.push_back({to, static_cast<double>(exact.shortening), static_cast<double>(exact.deflection)});
}

}  // namespace rubatlas::blade

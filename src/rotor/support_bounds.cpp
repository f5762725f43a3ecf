#include "rotor/support_bounds.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "integrate/decompositions.hpp"

namespace rubatlas::rotor {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix4d;
using Beside = Eigen::Matrix<double, 2, 4>;  ///< two 2×2 matrices that act on z and on z'

constexpr double kRounding = std::numeric_limits<double>::epsilon();

/// Above this condition a norm is of no use, and its μ drowns in rounding.
constexpr double kWorstCondition = 1e6;

/// A forcing closer to an eigenvalue than this, relative to the matrix, has no steady response to speak of:
/// the distance to it would bound nothing.
constexpr double kNearestResonance = 1e-10;

/// Largest singular value of a matrix with two rows or two columns: the root of the larger eigenvalue of its
/// Gram matrix, a quadratic.
template <class Matrix>
double largest_singular_value(const Matrix& matrix) {
  if constexpr (Matrix::RowsAtCompileTime != 2) {
    return largest_singular_value(matrix.adjoint().eval());
  } else {
    const double first = matrix.row(0).squaredNorm();
    const double second = matrix.row(1).squaredNorm();
    const double across = std::abs(matrix.row(1).dot(matrix.row(0)));
    return std::sqrt(0.5 * (first + second) + std::hypot(0.5 * (first - second), across));
  }
}

/// The same, rounded up.
template <class Matrix>
double spectral_norm(const Matrix& matrix) {
  return largest_singular_value(matrix) * (1.0 + 16.0 * kRounding);
}

Beside beside(const Matrix2d& of_position, const Matrix2d& of_velocity) {
  return (Beside() << of_position, of_velocity).finished();
}

const Matrix2d& quarter_turn() {
  static const Matrix2d turn = (Matrix2d() << 0.0, -1.0, 1.0, 0.0).finished();
  return turn;
}

/// No motion is fed by the damping: xᵀ C x >= 0 for all x.
bool never_feeds(const Matrix2d& damping) {
  const double off = 0.5 * (damping(0, 1) + damping(1, 0));
  return damping(0, 0) >= 0.0 && damping(1, 1) >= 0.0 && damping(0, 0) * damping(1, 1) >= off * off;
}

/// Largest value on [0, t] of a solution of b' = μ b + forcing from `start`, where growth is a bound only.
double grown(double start, double growth, double forcing, double horizon) {
  if (growth > 0.0) {
    if (start + forcing == 0.0) return 0.0;
    const double factor = std::expm1(growth * horizon);
    return std::isinf(factor) ? factor : start + (start + forcing / growth) * factor;
  }
  const double linear = forcing > 0.0 ? start + forcing * horizon : start;
  return growth < 0.0 ? std::min(linear, std::max(start, -forcing / growth)) : linear;
}

}  // namespace

SupportBounds::SupportBounds(const LinearSupport& support)
    : stiffness_(support.stiffness()),
      damping_(support.damping()),
      system_(support.system_matrix()),
      terms_(support.terms().begin(), support.terms().end()) {
  for (const HarmonicForcing& term : terms_) forcing_ += std::abs(term.amplitude);
  add_energy_norm();
  if (stiffness_ != Matrix2d::Identity()) add_norm(Matrix4d::Identity(), false);  // else they are one
  add_modal_norm();
  find_steady_response();
  const double growth = logarithmic_norm();
  growth_time_ = growth > 0.0 ? 1.0 / growth : std::numeric_limits<double>::infinity();

  second_ = {spectral_norm(beside(stiffness_, damping_)), forcing_};
  // z''' = C K z + (C² − K) z' − C f + f'.
  third_.slope = spectral_norm(beside(damping_ * stiffness_, damping_ * damping_ - stiffness_));
  for (const HarmonicForcing& term : terms_)
    third_.offset +=
        spectral_norm((term.frequency * quarter_turn() - damping_).eval()) * std::abs(term.amplitude);
  // z'''' = C K z' + (C² − K) z'' − C f' + f'', and z'' = −K z − C z' + f.
  const Matrix2d of_second = damping_ * damping_ - stiffness_;
  fourth_.slope =
      spectral_norm(beside(-of_second * stiffness_, damping_ * stiffness_ - of_second * damping_));
  for (const HarmonicForcing& term : terms_) {
    const double square = term.frequency * term.frequency;
    const Matrix2d of_forcing =
        of_second - term.frequency * damping_ * quarter_turn() - square * Matrix2d::Identity();
    fourth_.offset += spectral_norm(of_forcing) * std::abs(term.amplitude);
  }
}

void SupportBounds::add_norm(const Matrix4d& weight, bool never_grows) {
  const integrate::SchurForm axes = integrate::schur_form(weight);
  const Eigen::Vector4d values = axes.form.diagonal();
  const double smallest = values.minCoeff();
  const double largest = values.maxCoeff();
  if (!(smallest > 0.0) || largest > kWorstCondition * kWorstCondition * smallest) return;
  const Matrix4d shapes = axes.vectors;
  const Eigen::Vector4d roots = values.cwiseSqrt();
  const Matrix4d root = shapes * roots.asDiagonal() * shapes.transpose();
  double growth = 0.0;
  if (!never_grows) {
    const Matrix4d seen = root * system_ * (shapes * roots.cwiseInverse().asDiagonal() * shapes.transpose());
    const Matrix4d symmetric = 0.5 * (seen + seen.transpose());
    growth = integrate::schur_form(symmetric).form.diagonal().maxCoeff();
    growth += 64.0 * kRounding * std::sqrt(largest / smallest) * system_.norm();
  }
  const double rounded_up = 1.0 + 64.0 * kRounding * largest / smallest;
  const double widest = largest_singular_value(weight.bottomRightCorner<2, 2>().eval());
  norms_[norm_count_++] = {root, growth, rounded_up / std::sqrt(smallest), std::sqrt(widest) * rounded_up};
}

void SupportBounds::add_energy_norm() {
  const Matrix2d symmetric = 0.5 * (stiffness_ + stiffness_.transpose());
  Matrix4d weight = Matrix4d::Identity();
  weight.topLeftCorner<2, 2>() = symmetric;
  add_norm(weight, symmetric == stiffness_ && never_feeds(damping_));
}

void SupportBounds::add_modal_norm() {
  const integrate::EigenModes modes = integrate::eigen_modes(system_);
  Matrix4d real, imaginary;  // parts of the inverse of the shapes
  for (int i = 0; i < 4; ++i) {
    const Eigen::VectorXcd column = modes.coordinates(Eigen::Vector4d::Unit(i));
    real.col(i) = column.real();
    imaginary.col(i) = column.imag();
  }
  // Conjugate pairs: the product of the inverse with its adjoint is real. Where there is none, it is no norm.
  const Matrix4d weight = real.transpose() * real + imaginary.transpose() * imaginary;
  add_norm(0.5 * (weight + weight.transpose()), false);
}

void SupportBounds::find_steady_response() {
  // z = Re(w e^{iντ}) with (K − ν² + iνC) w = F (1, −i), since Im(F e^{iντ}) = Re(−iF e^{iντ}).
  using Complex = std::complex<double>;
  for (const HarmonicForcing& term : terms_) {
    Eigen::Matrix2cd dynamic = stiffness_.cast<Complex>();
    dynamic += Complex(0.0, term.frequency) * damping_.cast<Complex>();
    dynamic.diagonal().array() -= term.frequency * term.frequency;
    const double scale =
        stiffness_.norm() + std::abs(term.frequency) * damping_.norm() + term.frequency * term.frequency;
    const double smallest_singular_value = std::abs(dynamic.determinant()) / largest_singular_value(dynamic);
    if (!(smallest_singular_value > kNearestResonance * scale)) return;
    const Eigen::Vector2cd force(term.amplitude, term.amplitude * Complex(0.0, -1.0));
    const Eigen::Vector2cd shape = dynamic.inverse() * force;
    Eigen::Vector4cd phasor;
    phasor << shape, Complex(0.0, term.frequency) * shape;
    steady_.push_back((Eigen::Matrix<double, 4, 2>() << phasor.real(), -phasor.imag()).finished());
    steady_bound_ += spectral_norm(steady_.back());
  }
  has_steady_ = true;
}

SupportBounds::State SupportBounds::steady(double time) const {
  State sum = State::Zero();
  for (std::size_t j = 0; j < steady_.size(); ++j) {
    const double angle = terms_[j].frequency * time;
    sum += steady_[j].col(0) * std::cos(angle) + steady_[j].col(1) * std::sin(angle);
  }
  return sum;
}

double SupportBounds::amplitude_bound(double time, const State& state, double horizon) const {
  State distance = state;
  if (has_steady_) distance -= steady(time);
  double bound = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < norm_count_; ++i) {
    const Norm& norm = norms_[i];
    const double forced =
        grown((norm.root * state).norm(), norm.growth, norm.forcing_weight * forcing_, horizon);
    bound = std::min(bound, norm.to_amplitude * forced);
    if (has_steady_) {
      const double free = grown((norm.root * distance).norm(), norm.growth, 0.0, horizon);
      bound = std::min(bound, steady_bound_ + norm.to_amplitude * free);
    }
  }
  return bound;
}

double SupportBounds::logarithmic_norm() const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < norm_count_; ++i) least = std::min(least, norms_[i].growth);
  return least;
}

}  // namespace rubatlas::rotor

/// Random linear supports, and their flight as the exponential of one matrix in extended precision
/// (its series: no table, no splitting, no case distinctions).
#pragma once

#include <Eigen/Core>
#include <random>
#include <vector>

#include "integrate/decompositions.hpp"
#include "rotor/linear_support.hpp"

namespace rubatlas::rotor {

/// K within 1 of the isotropic shaft's and C within 0.3 of 0.3 I, entry by entry: two in five are unstable.
struct RandomSupport {
  RandomSupport(std::mt19937& random, std::size_t terms) {
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    stiffness.setIdentity();
    damping = 0.3 * Eigen::Matrix2d::Identity();
    for (int i = 0; i < 4; ++i) {
      stiffness(i / 2, i % 2) += any(random);
      damping(i / 2, i % 2) += 0.3 * any(random);
    }
    for (std::size_t j = 0; j < terms; ++j) {
      const double real = any(random), imaginary = any(random), frequency = 3 * any(random);
      forcing.push_back({{0.01 * real, 0.01 * imaginary}, j == 0 ? 0.0 : frequency});
    }
  }

  Eigen::Matrix2d stiffness;
  Eigen::Matrix2d damping;
  std::vector<HarmonicForcing> forcing;
};

/// Largest real part of the eigenvalues: how fast free motion grows [1 per unit τ].
inline double growth_rate(const LinearSupport& support) {
  return integrate::eigen_modes(support.system_matrix()).values.real().maxCoeff();
}

class ExactFlight {
 public:
  using Real = long double;
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

  /// The generator of (s, Re e^{iν_1 τ}, Im e^{iν_1 τ}, …).
  static Matrix generator(const LinearSupport& support) {
    const auto terms = support.terms();
    const auto size = 4 + 2 * static_cast<Eigen::Index>(terms.size());
    Matrix result = Matrix::Zero(size, size);
    result.topLeftCorner<4, 4>() = support.system_matrix().cast<Real>();
    for (std::size_t j = 0; j < terms.size(); ++j) {
      const auto at = 4 + 2 * static_cast<Eigen::Index>(j);
      const Real real = terms[j].amplitude.real(), imaginary = terms[j].amplitude.imag();
      result.block<2, 2>(2, at) << real, -imaginary, imaginary, real;
      result.block<2, 2>(at, at) << 0, -Real(terms[j].frequency), terms[j].frequency, 0;
    }
    return result;
  }

  /// Of so small a part that two dozen terms of the series are all of it, squared as often as that was
  /// halved.
  static Matrix exponential(Matrix exponent) {
    int halved = 0;
    for (; exponent.norm() > 0.5L; ++halved) exponent *= 0.5L;
    Matrix term = Matrix::Identity(exponent.rows(), exponent.cols());
    Matrix sum = term;
    for (int n = 1; n <= 24; ++n) {
      term = (term.lazyProduct(exponent) / Real(n)).eval();
      sum += term;
    }
    for (; halved > 0; --halved) sum = sum.lazyProduct(sum).eval();
    return sum;
  }

  /// (s, pairs) at `time`.
  static Vector whole(const LinearSupport& support, double time, const LinearSupport::State& state) {
    const auto terms = support.terms();
    Vector result(4 + 2 * static_cast<Eigen::Index>(terms.size()));
    result.head<4>() = state.cast<Real>();
    for (std::size_t j = 0; j < terms.size(); ++j) {
      const Real angle = Real(terms[j].frequency) * Real(time);
      result.segment<2>(4 + 2 * static_cast<Eigen::Index>(j)) << std::cos(angle), std::sin(angle);
    }
    return result;
  }

  ExactFlight(const LinearSupport& support, double elapsed)
      : support_(&support), flow_(exponential(generator(support) * Real(elapsed))) {}

  [[nodiscard]] LinearSupport::State state(double start_time, const LinearSupport::State& start) const {
    return flow_.lazyProduct(whole(*support_, start_time, start)).head<4>().cast<double>();
  }

  /// Largest motion that a start of this size and the forcing can have at the end.
  [[nodiscard]] double scale(const LinearSupport::State& start) const {
    const Matrix support = flow_.topRows<4>();
    return static_cast<double>(support.leftCols<4>().norm()) * start.norm() +
           static_cast<double>(support.rightCols(support.cols() - 4).norm());
  }

 private:
  const LinearSupport* support_;
  Matrix flow_;
};

}  // namespace rubatlas::rotor

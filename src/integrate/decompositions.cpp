#include "integrate/decompositions.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <array>
#include <limits>

namespace rubatlas::integrate {

EigenModes eigen_modes(const Eigen::MatrixXd& matrix) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SchurForm schur_form(const Eigen::MatrixXd& matrix) {
  const Eigen::RealSchur<Eigen::MatrixXd> schur(matrix);
  return {schur.matrixU(), schur.matrixT()};
}

Eigen::VectorXcd EigenModes::coordinates(const Eigen::VectorXd& vector) const {
  // In real and imaginary parts: the decomposition of complex matrices would take the compiler seconds.
  const Eigen::Index count = vector.size();
  Eigen::MatrixXd parts(2 * count, 2 * count);
  parts << shapes.real(), -shapes.imag(), shapes.imag(), shapes.real();
  Eigen::VectorXd right = Eigen::VectorXd::Zero(2 * count);
  right.head(count) = vector;
  const Eigen::MatrixXd solved = solve(parts, right);
  Eigen::VectorXcd result(count);
  result.real() = solved.topRows(count);
  result.imag() = solved.bottomRows(count);
  return result;
}

/// From those of (A − σB)⁻¹ B, which are 1/(λ − σ). Of some σ, more than there are λ, the one that is
/// farthest from them: where either matrix has no inverse, that of A − σB loses no digits.
Eigen::Vector4cd generalised_eigenvalues(const Eigen::Matrix4d& matrix, const Eigen::Matrix4d& other) {
  constexpr std::array kShifts{0.3, -0.4, 0.7, -0.6, 1.6, -1.7};
  double least = std::numeric_limits<double>::infinity();
  double shift = 0.0;
  Eigen::Matrix4d shifted = Eigen::Matrix4d::Zero();
  for (const double candidate : kShifts) {
    const Eigen::Matrix4d there = solve(matrix - candidate * other, other);
    if (!(there.norm() < least)) continue;
    least = there.norm();
    shift = candidate;
    shifted = there;
  }
  return shift + eigen_modes(shifted).values.array().inverse();
}

OrthogonalFactors orthogonal_factors(const Eigen::MatrixXd& matrix) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> factors(matrix);
  return {factors.householderQ(), factors.matrixQR().diagonal()};
}

Eigen::MatrixXd solve(Eigen::MatrixXd matrix, const Eigen::MatrixXd& right) {
  return Eigen::PartialPivLU<Eigen::Ref<Eigen::MatrixXd>>(matrix).solve(right);
}

LongMatrix solve_long(const LongMatrix& matrix, const LongMatrix& right) {
  return matrix.fullPivLu().solve(right);
}

}  // namespace rubatlas::integrate

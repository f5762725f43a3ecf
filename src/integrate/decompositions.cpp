#include "integrate/decompositions.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace rubatlas::integrate {

EigenModes eigen_modes(const Eigen::Matrix4d& matrix) {
  const Eigen::EigenSolver<Eigen::Matrix4d> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SymmetricModes symmetric_modes(const Eigen::Matrix4d& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::MatrixXd solve(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right) {
  return matrix.partialPivLu().solve(right);
}

}  // namespace rubatlas::integrate

#include "integrate/eigen_modes.hpp"

#include <Eigen/Eigenvalues>

namespace rubatlas::integrate {

EigenModes eigen_modes(const Eigen::Matrix4d& matrix) {
  const Eigen::EigenSolver<Eigen::Matrix4d> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace rubatlas::integrate

#include <Eigen/Eigenvalues>

#include "integrate/decompositions.hpp"

namespace rubatlas::integrate {

Eigen::Vector4cd generalised_eigenvalues(const Eigen::Matrix4d& matrix, const Eigen::Matrix4d& other) {
  return Eigen::GeneralizedEigenSolver<Eigen::Matrix4d>(matrix, other, false).eigenvalues();
}

}  // namespace rubatlas::integrate

/// What the other folders ask of Eigen's decompositions: functions of their own, since each takes five to ten
/// seconds of the compiler's time wherever it is used.
#pragma once

#include <Eigen/Core>

namespace rubatlas::integrate {

struct EigenModes {
  Eigen::Vector4cd values;
  Eigen::Matrix4cd shapes;  ///< a column for each value, of length 1
};
EigenModes eigen_modes(const Eigen::Matrix4d& matrix);

/// λ with det(`matrix` − λ `other`) = 0; infinite where `other` has no inverse.
Eigen::Vector4cd generalised_eigenvalues(const Eigen::Matrix4d& matrix, const Eigen::Matrix4d& other);

struct SymmetricModes {
  Eigen::Vector4d values;  ///< ascending
  Eigen::Matrix4d shapes;  ///< a column for each value, orthonormal
};
SymmetricModes symmetric_modes(const Eigen::Matrix4d& matrix);

/// x with `matrix` x = `right`, column by column; the matrix has an inverse.
Eigen::MatrixXd solve(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right);

}  // namespace rubatlas::integrate

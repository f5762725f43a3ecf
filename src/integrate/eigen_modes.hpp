/// Eigenvalues and eigenvectors of a matrix of order four: a function of its own, since Eigen's takes a
/// quarter of a minute of the compiler's time wherever it is used.
#pragma once

#include <Eigen/Core>

namespace rubatlas::integrate {

struct EigenModes {
  Eigen::Vector4cd values;
  Eigen::Matrix4cd shapes;  ///< a column for each value, of length 1
};

EigenModes eigen_modes(const Eigen::Matrix4d& matrix);

}  // namespace rubatlas::integrate

/// What the other folders ask of Eigen's decompositions: functions of their own, since each takes five to ten
/// seconds of the compiler's time wherever it is used.
#pragma once

#include <Eigen/Core>

namespace rubatlas::integrate {

struct EigenModes {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd shapes;  ///< a column for each value, of length 1

  /// `shapes` w = `vector`.
  [[nodiscard]] Eigen::VectorXcd coordinates(const Eigen::VectorXd& vector) const;
};
EigenModes eigen_modes(const Eigen::MatrixXd& matrix);

/// `matrix` = Q T Qᵀ: Q orthogonal, T triangular but for a block of two on its diagonal for each complex
/// pair. Of a symmetric matrix: eigenvalues on the diagonal, orthonormal shapes in the columns of Q.
struct SchurForm {
  Eigen::MatrixXd vectors;  ///< Q
  Eigen::MatrixXd form;     ///< T
};
SchurForm schur_form(const Eigen::MatrixXd& matrix);

/// λ with det(`matrix` − λ `other`) = 0; very large where `other` has no inverse.
Eigen::Vector4cd generalised_eigenvalues(const Eigen::Matrix4d& matrix, const Eigen::Matrix4d& other);

/// `matrix` = Q R: Q orthogonal and square, R triangular.
struct OrthogonalFactors {
  Eigen::MatrixXd orthogonal;
  Eigen::VectorXd diagonal;  ///< of R
};
OrthogonalFactors orthogonal_factors(const Eigen::MatrixXd& matrix);

/// x with `matrix` x = `right`, column by column; the matrix has an inverse.
Eigen::MatrixXd solve(Eigen::MatrixXd matrix, const Eigen::MatrixXd& right);

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
/// The same for fits of polynomials, of which `double` would lose digits.
LongMatrix solve_long(const LongMatrix& matrix, const LongMatrix& right);

}  // namespace rubatlas::integrate

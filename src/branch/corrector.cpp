#include "branch/corrector.hpp"

#include <cmath>

#include "integrate/decompositions.hpp"

namespace rubatlas::branch {

Unknowns null_direction(const Rows& rows, const Unknowns& along) {
  const Unknowns direction = integrate::orthogonal_factors(rows.transpose()).orthogonal.rightCols<1>();
  return direction.dot(along) < 0.0 ? Unknowns(-direction) : direction;
}

Unknowns newton_step(const Rows& rows, const Eigen::VectorXd& values, const Unknowns& tangent) {
  Rows matrix(rows.cols(), rows.cols());
  matrix.topRows(rows.rows()) = rows;
  matrix.bottomRows(1) = tangent.transpose();
  Eigen::VectorXd right(rows.cols());
  right.head(rows.rows()) = -values;
  right[rows.cols() - 1] = 0.0;
  return integrate::solve(matrix, right);
}

std::optional<OnBranch> Corrector::correct(const Unknowns& predicted, const Unknowns& tangent) {
  Unknowns at = predicted;
  for (iterations_ = 0; iterations_ < kMostIterations; ++iterations_) {
    const auto orbit = shooting_->orbit(at);
    if (!orbit) return std::nullopt;
    const auto rows = shooting_->derivative(at, *orbit);
    if (!rows) return std::nullopt;
    if (shooting_->closes(at, *orbit)) return OnBranch{at, *orbit, null_direction(*rows, tangent)};
    const Unknowns step = newton_step(*rows, orbit->mismatch, tangent);
    if (!step.allFinite() || step.norm() > 1.0) return std::nullopt;
    at += step;
  }
  return std::nullopt;
}

double Corrector::difference(const OnBranch& a, const OnBranch& b) const {
  return std::abs(shooting_->quantity(a.at, 0) - shooting_->quantity(b.at, 0));
}

}  // namespace rubatlas::branch

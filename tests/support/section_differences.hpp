/// The derivative of the section map by differences, for tests of the linearised flow.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "point/line_solver.hpp"

namespace rubatlas::test {

/// Central differences of the section map, of order 4, and the estimate of their error, relative.
struct Differences {
  Eigen::MatrixXd jacobian;
  double error;
};
/// Of a map of vectors.
Differences differences(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& map,
                        const Eigen::VectorXd& start, double step);
/// `step`: of the differences [m].
Differences differences(point::LineSolver& solver, double speed_ratio, const motion::SectionState& start,
                        int revolutions, double step);

}  // namespace rubatlas::test

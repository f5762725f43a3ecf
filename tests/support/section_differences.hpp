/// The derivative of the section map by differences, for tests of the linearised flow.
#pragma once

#include <Eigen/Core>

#include "point/line_solver.hpp"

namespace rubatlas::test {

/// Central differences of the section map, of order 4, and the estimate of their error, relative.
struct Differences {
  Eigen::Matrix4d jacobian;
  double error;
};
/// `step`: of the differences [m].
Differences differences(point::LineSolver& solver, double speed_ratio, const motion::SectionState& start,
                        int revolutions, double step);

}  // namespace rubatlas::test

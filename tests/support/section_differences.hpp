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
/// A map of vectors.
using Map = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;
Differences differences(const Map& map, const Eigen::VectorXd& start, double step);
/// `step`: of the differences [m].
Differences differences(point::LineSolver& solver, double speed_ratio, const motion::SectionState& start,
                        int revolutions, double step);

double determinant(const Eigen::MatrixXd& matrix);
/// By which factor a map changes volume at a point: the determinant of the same differences.
double change_of_volume(const Map& map, const Eigen::VectorXd& start, double step);

}  // namespace rubatlas::test

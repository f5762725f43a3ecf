#include "section_differences.hpp"

#include "integrate/decompositions.hpp"
#include "rotor/constants.hpp"

namespace rubatlas::test {
namespace {

Eigen::MatrixXd derivative(const Map& map, const Eigen::VectorXd& start, double step) {
  Eigen::MatrixXd jacobian(start.size(), start.size());
  for (Eigen::Index column = 0; column < start.size(); ++column) {
    const auto moved = [&](double by) {
      Eigen::VectorXd from = start;
      from[column] += by;
      return map(from);
    };
    const Eigen::VectorXd near = moved(step) - moved(-step);
    const Eigen::VectorXd far = moved(2.0 * step) - moved(-2.0 * step);
    jacobian.col(column) = (8.0 * near - far) / (12.0 * step);
  }
  return jacobian;
}

}  // namespace

Differences differences(const Map& map, const Eigen::VectorXd& start, double step) {
  const Eigen::MatrixXd fine = derivative(map, start, step);
  return {fine, (fine - derivative(map, start, 0.5 * step)).norm() / fine.norm()};
}

Differences differences(point::LineSolver& solver, double speed_ratio, const motion::SectionState& start,
                        int revolutions, double step) {
  const auto map = [&](const Eigen::VectorXd& from) -> Eigen::VectorXd {
    const motion::SectionState state{from[0], from[1], from[2], from[3]};
    return rotor::as_state(solver.section_map(speed_ratio, state, revolutions).sections.back()).matrix();
  };
  return differences(map, rotor::as_state(start).matrix(), step);
}

double determinant(const Eigen::MatrixXd& matrix) {
  return integrate::eigen_modes(matrix).values.prod().real();
}

double change_of_volume(const Map& map, const Eigen::VectorXd& start, double step) {
  return determinant(derivative(map, start, step));
}

}  // namespace rubatlas::test

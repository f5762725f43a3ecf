#include "section_differences.hpp"

#include "rotor/constants.hpp"

namespace rubatlas::test {

Differences differences(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& map,
                        const Eigen::VectorXd& start, double step) {
  const auto along = [&](double size) {
    Eigen::MatrixXd jacobian(start.size(), start.size());
    for (Eigen::Index column = 0; column < start.size(); ++column) {
      const auto moved = [&](double by) {
        Eigen::VectorXd from = start;
        from[column] += by;
        return map(from);
      };
      const Eigen::VectorXd near = moved(size) - moved(-size);
      const Eigen::VectorXd far = moved(2.0 * size) - moved(-2.0 * size);
      jacobian.col(column) = (8.0 * near - far) / (12.0 * size);
    }
    return jacobian;
  };
  const Eigen::MatrixXd fine = along(step);
  return {fine, (fine - along(0.5 * step)).norm() / fine.norm()};
}

Differences differences(point::LineSolver& solver, double speed_ratio, const motion::SectionState& start,
                        int revolutions, double step) {
  const auto map = [&](const Eigen::VectorXd& from) -> Eigen::VectorXd {
    const motion::SectionState state{from[0], from[1], from[2], from[3]};
    return rotor::as_state(solver.section_map(speed_ratio, state, revolutions).sections.back()).matrix();
  };
  return differences(map, rotor::as_state(start).matrix(), step);
}

}  // namespace rubatlas::test

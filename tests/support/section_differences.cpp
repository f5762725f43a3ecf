#include "section_differences.hpp"

#include <cstddef>

#include "rotor/constants.hpp"

namespace rubatlas::test {

Differences differences(point::LineSolver& solver, double speed_ratio, const motion::SectionState& start,
                        int revolutions, double step) {
  const auto along = [&](double size) {
    Eigen::Matrix4d jacobian;
    for (int column = 0; column < 4; ++column) {
      const auto moved = [&](double by) {
        motion::PointStart from = start;
        from.state[static_cast<std::size_t>(column)] += by;
        return rotor::as_state(solver.section_map(speed_ratio, from, revolutions).sections.back());
      };
      const rotor::State near = moved(size) - moved(-size);
      const rotor::State far = moved(2.0 * size) - moved(-2.0 * size);
      jacobian.col(column) = ((8.0 * near - far) / (12.0 * size)).matrix();
    }
    return jacobian;
  };
  const Eigen::Matrix4d fine = along(step);
  return {fine, (fine - along(0.5 * step)).norm() / fine.norm()};
}

}  // namespace rubatlas::test

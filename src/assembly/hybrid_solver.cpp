// What all laws of contact share: their blades, and the method.

#include <algorithm>
#include <limits>
#include <memory>
#include <span>
#include <utility>

#include "assembly/machine.hpp"
#include "assembly/methods.hpp"
#include "motion/motion.hpp"
#include "point/solver_of_motions.hpp"
#include "settings/effects/list.hpp"

namespace rubatlas::assembly {

std::vector<settings::Blades> each_blade(const settings::Scene& line) {
  const auto count = static_cast<std::size_t>(line.blades.count);
  std::vector<settings::Blades> blades(count, line.blades);
  if (!line.unequal_blades) return blades;
  const auto errors = line.unequal_blades->errors(line.blades.count);
  for (std::size_t k = 0; k < count; ++k) {
    blades[k].length += errors[k].length;
    blades[k].thickness += errors[k].thickness;
  }
  return blades;
}

std::unique_ptr<point::LineSolver> hybrid_solver(const LineRequest& request, modes::MakeModes make_modes) {
  return point::solver_of_motions(
      request.line,
      [line = request.line, kind = request.combination.machine, make_modes = std::move(make_modes)](
          double speed_ratio, std::span<const double> lost) -> std::unique_ptr<motion::PointMotion> {
        rotor::Machine machine = machine_of(line, kind, speed_ratio);
        // No step can be closer than positions are rounded: a clearance of nanometres asks for more.
        const double rounding = std::numeric_limits<double>::epsilon() * line.ring.radius;
        const double tolerance = std::max(line.accuracy.tolerance * machine.constants.length_scale, rounding);
        const motion::Motion::Settings settings{{tolerance, line.validity.max_shortening},
                                                line.accuracy.method == settings::Method::collocation};
        return std::make_unique<motion::Motion>(std::move(machine), make_modes, settings, lost);
      });
}

}  // namespace rubatlas::assembly

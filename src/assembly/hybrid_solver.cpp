// The method of hybrid motions.

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

std::unique_ptr<point::LineSolver> hybrid_solver(const LineRequest& request, modes::MakePhases* make_phases) {
  return point::solver_of_motions(
      request.line,
      [line = request.line, kind = request.combination.machine,
       law = std::shared_ptr<const modes::Law>(law_of(request)), make_phases](
          double speed_ratio, std::span<const double> lost) -> std::unique_ptr<motion::PointMotion> {
        rotor::Machine machine = machine_of(line, kind, speed_ratio);
        // No step can be closer than positions are rounded: a clearance of nanometres asks for more.
        const double rounding = std::numeric_limits<double>::epsilon() * line.ring.radius;
        const double tolerance = std::max(line.accuracy.tolerance * machine.constants.length_scale, rounding);
        const motion::Motion::Settings settings{{tolerance, line.validity.max_shortening}, make_phases};
        return std::make_unique<motion::Motion>(std::move(machine), law->of_shortened(lost), settings);
      });
}

}  // namespace rubatlas::assembly

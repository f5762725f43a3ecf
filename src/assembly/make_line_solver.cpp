#include "assembly/make_line_solver.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>

#include "assembly/blade_tables.hpp"
#include "assembly/methods.hpp"
#include "motion/motion.hpp"
#include "plan/scene_of_line.hpp"
#include "point/solver_of_motions.hpp"
#include "variation/parts_of_scene.hpp"

namespace rubatlas::assembly {

std::unique_ptr<point::LineSolver> hybrid_solver(const LineRequest& request, modes::MakePhases* make_phases) {
  return point::solver_of_motions(
      request.line,
      [line = request.line, law = std::shared_ptr<const collocation::Law>(law_of(request)), make_phases](
          double speed_ratio, std::span<const double> lost) -> std::unique_ptr<motion::PointMotion> {
        rotor::Machine machine = variation::machine_of(line, speed_ratio);
        // No step can be closer than positions are rounded: a clearance of nanometres asks for more.
        const double rounding = std::numeric_limits<double>::epsilon() * line.ring.radius;
        const double tolerance = std::max(line.accuracy.tolerance * machine.constants.length_scale, rounding);
        const modes::ContactLimits limits{tolerance, line.validity.max_shortening};
        return std::make_unique<motion::Motion>(std::move(machine), law->of_shortened(lost), limits,
                                                make_phases);
      });
}

std::shared_ptr<BladeTables> make_blade_tables() {
  return std::make_shared<BladeTables>();
}

std::unique_ptr<point::LineSolver> make_line_solver(const settings::Scene& scene,
                                                    const plan::PointParameters& line,
                                                    const std::shared_ptr<BladeTables>& tables) {
  const settings::Scene own = plan::scene_of_line(scene, line);
  const LineRequest request{own, *tables, settings::combination_of(own)};
  switch (own.accuracy.method) {
    case settings::Method::collocation:
      return hybrid_solver(request, modes::phases_on_arcs);
    case settings::Method::hybrid:
      return hybrid_solver(request, phases_in_steps);
    case settings::Method::hybrid_54:
      return make_hybrid_54(request);
    case settings::Method::hybrid_32:
      return make_hybrid_32(request);
    case settings::Method::paper:
      return make_paper(request);
    case settings::Method::located:
      return make_located(request);
    case settings::Method::fixed:
      return make_fixed(request);
  }
  throw std::logic_error("a method of integration that is none");
}

motion::SectionState initial_state(const settings::Scene& scene, const plan::PointParameters& point) {
  const settings::Initial initial = plan::scene_of_line(scene, point).initial;
  return {initial.x, initial.y, initial.vx, initial.vy};
}

}  // namespace rubatlas::assembly

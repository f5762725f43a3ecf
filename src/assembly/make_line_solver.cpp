#include "assembly/make_line_solver.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include "assembly/blade_tables.hpp"
#include "assembly/machine.hpp"
#include "assembly/methods.hpp"
#include "motion/motion.hpp"
#include "plan/scene_of_line.hpp"
#include "point/solver_of_motions.hpp"
#include "settings/effects/list.hpp"

namespace rubatlas::assembly {

namespace {

modes::MakeModes law_of(const LineRequest& request) {
  using enum settings::MotionFamily;
  const bool rigid = request.line.contact.law == settings::ContactLaw::elastic_ring;
  switch (request.combination.family->kind) {
    case directed_elastic_blades:
    case sticking_elastic_blades:
      return law_of_inclined_loads(request);
    case blades_on_damped_ring:
      return law_of_damped_ring(request);
    default:
      return rigid ? law_of_rigid_blades(request) : law_of_axial_loads(request);
  }
}

std::unique_ptr<point::LineSolver> make(const LineRequest& request) {
  switch (request.line.accuracy.method) {
    case settings::Method::hybrid:
    case settings::Method::collocation:
      return hybrid_solver(request, law_of(request));
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

}  // namespace

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

std::shared_ptr<BladeTables> make_blade_tables() {
  return std::make_shared<BladeTables>();
}

std::unique_ptr<point::LineSolver> make_line_solver(const settings::Scene& scene,
                                                    const plan::PointParameters& line,
                                                    const std::shared_ptr<BladeTables>& tables) {
  const settings::Scene own = plan::scene_of_line(scene, line);
  return make({own, *tables, settings::combination_of(own)});
}

}  // namespace rubatlas::assembly

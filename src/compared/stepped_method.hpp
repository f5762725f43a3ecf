/// The paper's rotor by the methods that ours is compared with.
///
/// `Scheme`: what `compared::SteppedMotion` asks of one, and of a scene
///     largest_step(accuracy)   τ
///     search(accuracy)         how forces are found
#pragma once

#include <memory>
#include <span>
#include <utility>

#include "assembly/methods.hpp"
#include "compared/stepped_motion.hpp"
#include "point/solver_of_motions.hpp"
#include "variation/parts_of_scene.hpp"

namespace rubatlas::compared {

template <class Scheme>
std::unique_ptr<point::LineSolver> stepped_solver(const assembly::LineRequest& request) {
  return point::solver_of_motions(
      request.line,
      [line = request.line, law = std::shared_ptr<const collocation::Law>(assembly::law_of(request))](
          double speed_ratio, std::span<const double> lost) -> std::unique_ptr<motion::PointMotion> {
        rotor::Machine machine = variation::machine_of(line, speed_ratio);
        const SteppedLimits limits{line.accuracy.tolerance * machine.constants.length_scale,
                                   Scheme::largest_step(line.accuracy), line.validity.max_shortening};
        return std::make_unique<SteppedMotion<Scheme>>(std::move(machine), law->of_shortened(lost),
                                                       Scheme::search(line.accuracy), limits);
      });
}

}  // namespace rubatlas::compared

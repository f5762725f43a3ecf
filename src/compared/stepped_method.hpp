/// The paper's rotor by the methods that ours is compared with.
///
/// `Scheme`: what `compared::SteppedMotion` asks of one, and of a scene
///     largest_step(accuracy)   τ
///     search(accuracy)         how forces are found
#pragma once

#include <memory>
#include <span>
#include <utility>

#include "assembly/machine.hpp"
#include "assembly/methods.hpp"
#include "compared/stepped_motion.hpp"
#include "point/solver_of_motions.hpp"

namespace rubatlas::compared {

/// `blade`: the law of all blades, which are alike.
template <class Scheme, class Blade>
std::unique_ptr<point::LineSolver> stepped_solver_of(const assembly::LineRequest& request,
                                                     const Blade& blade) {
  return point::solver_of_motions(
      request.line,
      [line = request.line, kind = request.combination.machine, blade](
          double speed_ratio, std::span<const double> /*lost*/) -> std::unique_ptr<motion::PointMotion> {
        rotor::Machine machine = assembly::machine_of(line, kind, speed_ratio);
        const SteppedLimits limits{line.accuracy.tolerance * machine.constants.length_scale,
                                   Scheme::largest_step(line.accuracy), line.validity.max_shortening};
        return std::make_unique<SteppedMotion<Blade, Scheme>>(std::move(machine), blade,
                                                              Scheme::search(line.accuracy), limits);
      });
}

template <class Scheme>
std::unique_ptr<point::LineSolver> stepped_solver(const assembly::LineRequest& request) {
  if (request.line.contact.law == settings::ContactLaw::elastic_ring)
    return stepped_solver_of<Scheme>(request, assembly::elastic_ring_of_blades(request.line).front());
  return stepped_solver_of<Scheme>(request, assembly::elastica_of_blades(request).front());
}

}  // namespace rubatlas::compared

// `fixed`: classical Runge–Kutta in equal steps, a whole number of them in a revolution; contact by the sign
// of g in each stage, events nowhere. What people write first.

#include "integrate/classical_runge_kutta.hpp"
#include "solve/stepped_motion.hpp"
#include "solve/typed_line_solver.hpp"

namespace rubatlas::solve {
namespace {

struct Fixed {
  using Table = integrate::ClassicalRungeKutta;
  using Search = SolvedForce;
  static constexpr bool kAdaptive = false;
  static constexpr bool kLocated = false;

  template <class Law, class Forcing, class Blades>
  using Motion = SteppedMotion<Law, Forcing, Fixed>;

  template <class Law, class Forcing>
  static auto make(const RotorConstants& rotor, const BladeSet& blades, const Law& law,
                   const Forcing& forcing, const scene::Scene& scene) {
    const SteppedLimits limits{scene.accuracy.tolerance * rotor.length_scale, scene.accuracy.step,
                               scene.validity.max_shortening};
    return std::make_unique<Motion<Law, Forcing, BladeSet>>(rotor, blades, law, forcing, Search{}, limits);
  }
};

}  // namespace

std::unique_ptr<LineSolver> make_fixed(const LineRequest& request) {
  return make_typed_line_solver<Fixed>(request);
}

}  // namespace rubatlas::solve

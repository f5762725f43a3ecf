// `fixed`: classical Runge–Kutta in equal steps, a whole number of them in a revolution; contact by the sign
// of g in each stage, events nowhere. What people write first.

#include "integrate/classical_runge_kutta.hpp"
#include "solve/stepped_motion.hpp"
#include "solve/typed_motions.hpp"

namespace rubatlas::solve {
namespace {

struct Fixed {
  using Table = integrate::ClassicalRungeKutta;
  using Search = SolvedForce;
  static constexpr bool kAdaptive = false;
  static constexpr bool kLocated = false;

  template <bool kMayChange, class Law, class Forcing>
  static std::unique_ptr<PointMotion> make(const RotorConstants& rotor, const BladeSet& blades,
                                           const Law& law, const Forcing& forcing,
                                           const scene::Scene& scene) {
    const SteppedLimits limits{scene.accuracy.tolerance * rotor.length_scale, scene.accuracy.step,
                               scene.validity.max_shortening};
    return std::make_unique<TypedMotion<SteppedMotion<Law, Forcing, Fixed>, kMayChange>>(
        rotor, blades, law, forcing, Search{}, limits);
  }
};

}  // namespace

std::unique_ptr<LineSolver> make_fixed(const LineRequest& request) {
  return make_paper_s_rotor<Fixed>(request);
}

}  // namespace rubatlas::solve

// `fixed`: classical Runge–Kutta in equal steps, a whole number of them in a revolution; contact by the sign
// of g in each stage, events nowhere. What people write first.

#include "assembly/typed_motions.hpp"
#include "compared/stepped_motion.hpp"
#include "integrate/classical_runge_kutta.hpp"

namespace rubatlas::assembly {
namespace {

struct Fixed {
  using Table = integrate::ClassicalRungeKutta;
  using Search = compared::SolvedForce;
  static constexpr bool kAdaptive = false;
  static constexpr bool kLocated = false;

  template <bool kMayChange, class Law, class Forcing>
  static std::unique_ptr<motion::PointMotion> make(const rotor::RotorConstants& rotor,
                                                   const rotor::BladeSet& blades, const Law& law,
                                                   const Forcing& forcing, const settings::Scene& scene) {
    const compared::SteppedLimits limits{scene.accuracy.tolerance * rotor.length_scale, scene.accuracy.step,
                                         scene.validity.max_shortening};
    return std::make_unique<motion::TypedMotion<compared::SteppedMotion<Law, Forcing, Fixed>, kMayChange>>(
        rotor, blades, law, forcing, Search{}, limits);
  }
};

}  // namespace

std::unique_ptr<point::LineSolver> make_fixed(const LineRequest& request) {
  return make_paper_s_rotor<Fixed>(request);
}

}  // namespace rubatlas::assembly

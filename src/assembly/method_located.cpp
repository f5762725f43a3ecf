// `located`: an adaptive Runge–Kutta pair of order 5(4) over flight and contact alike; touch-downs, lift-offs
// and slip reversals are found by sign changes over a step and located on dense output, and the force is
// solved for in each stage. What a good general library for differential equations does.

#include "assembly/typed_motions.hpp"
#include "compared/stepped_motion.hpp"
#include "integrate/dormand_prince_54.hpp"

namespace rubatlas::assembly {
namespace {

struct Located {
  using Table = integrate::DormandPrince54;
  using Search = compared::SolvedForce;
  static constexpr bool kAdaptive = true;
  static constexpr bool kLocated = true;

  template <bool kMayChange, class Law, class Forcing>
  static std::unique_ptr<motion::PointMotion> make(const rotor::RotorConstants& rotor,
                                                   const rotor::BladeSet& blades, const Law& law,
                                                   const Forcing& forcing, const settings::Scene& scene) {
    const compared::SteppedLimits limits{scene.accuracy.tolerance * rotor.length_scale,
                                         scene.accuracy.max_step, scene.validity.max_shortening};
    return std::make_unique<motion::TypedMotion<compared::SteppedMotion<Law, Forcing, Located>, kMayChange>>(
        rotor, blades, law, forcing, Search{}, limits);
  }
};

}  // namespace

std::unique_ptr<point::LineSolver> make_located(const LineRequest& request) {
  return make_paper_s_rotor<Located>(request);
}

}  // namespace rubatlas::assembly

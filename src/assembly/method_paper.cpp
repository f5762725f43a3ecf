// `paper`: the published scheme, an adaptive Runge–Kutta method of order 4 over flight and contact alike,
// with contact by the sign of g in each stage and the force by upward stepping (MODEL 4.2). The paper names
// neither the pair nor the increment: Fehlberg's 4(5), whose solution is of order 4, and the increment of the
// scene.

#include "assembly/typed_motions.hpp"
#include "compared/stepped_motion.hpp"
#include "integrate/fehlberg_45.hpp"

namespace rubatlas::assembly {
namespace {

struct Paper {
  using Table = integrate::Fehlberg45;
  struct Search {
    double increment;  ///< dF [N]
    template <class Law>
    bool operator()(const Law& law, const contact::Pose& at, double slip, double speed_ratio,
                    double& /*bending*/, contact::TipForce& force) const {
      return law.respond_upwards(at, slip, speed_ratio, increment, force);
    }
  };
  static constexpr bool kAdaptive = true;
  static constexpr bool kLocated = false;

  template <bool kMayChange, class Law, class Forcing>
  static std::unique_ptr<motion::PointMotion> make(const rotor::RotorConstants& rotor,
                                                   const rotor::BladeSet& blades, const Law& law,
                                                   const Forcing& forcing, const settings::Scene& scene) {
    const compared::SteppedLimits limits{scene.accuracy.tolerance * rotor.length_scale,
                                         scene.accuracy.max_step, scene.validity.max_shortening};
    return std::make_unique<motion::TypedMotion<compared::SteppedMotion<Law, Forcing, Paper>, kMayChange>>(
        rotor, blades, law, forcing, Search{scene.accuracy.force_increment}, limits);
  }
};

}  // namespace

std::unique_ptr<point::LineSolver> make_paper(const LineRequest& request) {
  return make_paper_s_rotor<Paper>(request);
}

}  // namespace rubatlas::assembly

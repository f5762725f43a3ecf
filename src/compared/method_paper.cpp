// `paper`: the published scheme, an adaptive Runge–Kutta method of order 4 over flight and contact alike,
// with contact by the sign of g in each stage and the force by upward stepping (MODEL 4.2). The paper names
// neither the pair nor the increment: Fehlberg's 4(5), whose solution is of order 4, and the increment of the
// scene.

#include "compared/stepped_method.hpp"
#include "integrate/fehlberg_45.hpp"

namespace rubatlas::assembly {
namespace {

struct Paper {
  using Table = integrate::Fehlberg45;
  struct Search {
    double increment;  ///< dF [N]
    template <class Law>
    bool operator()(const Law& law, const contact::Pose& at, double slip, double angular_speed,
                    double& /*bending*/, contact::TipForce& force) const {
      return law.respond_upwards(at, slip, angular_speed, increment, force);
    }
  };
  static constexpr bool kAdaptive = true;
  static constexpr bool kLocated = false;

  static double largest_step(const settings::Accuracy& accuracy) { return accuracy.max_step; }
  static Search search(const settings::Accuracy& accuracy) { return {accuracy.force_increment}; }
};

}  // namespace

std::unique_ptr<point::LineSolver> make_paper(const LineRequest& request) {
  return compared::stepped_solver<Paper>(request);
}

}  // namespace rubatlas::assembly

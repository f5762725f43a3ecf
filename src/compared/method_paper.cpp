// `paper`: the published scheme, an adaptive Runge–Kutta method of order 4 over flight and contact alike,
// with contact by the sign of g in each stage and the force by upward stepping (MODEL 4.2). The paper names
// neither the pair nor the increment: Fehlberg's 4(5), whose solution is of order 4, and the increment of the
// scene.

#include "collocation/axial_law.hpp"
#include "collocation/rigid_law.hpp"
#include "compared/raised_force.hpp"
#include "compared/stepped_method.hpp"
#include "integrate/fehlberg_45.hpp"

namespace rubatlas::assembly {
namespace {

struct Paper {
  using Table = integrate::Fehlberg45;
  struct Search {
    double increment;  ///< dF [N]
    bool operator()(const collocation::Law& law, const modes::TipPlace& at, const modes::OpenContact& contact,
                    contact::TipForce& force) const {
      const auto respond = [&](const auto& blade) {
        return compared::raise_force(blade, at.pose, contact.slip, at.speed, increment, force);
      };
      if (const auto* rigid = dynamic_cast<const collocation::RigidLaw*>(&law))
        return respond(rigid->of(contact.blade));
      return respond(dynamic_cast<const collocation::AxialLaw&>(law).of(contact.blade));
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

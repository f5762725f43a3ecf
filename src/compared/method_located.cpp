// `located`: an adaptive Runge–Kutta pair of order 5(4) over flight and contact alike; touch-downs, lift-offs
// and slip reversals are found by sign changes over a step and located on dense output, and the force is
// solved for in each stage. What a good general library for differential equations does.

#include "compared/stepped_method.hpp"
#include "integrate/dormand_prince_54.hpp"

namespace rubatlas::assembly {
namespace {

struct Located {
  using Table = integrate::DormandPrince54;
  using Search = compared::SolvedForce;
  static constexpr bool kAdaptive = true;
  static constexpr bool kLocated = true;

  static double largest_step(const settings::Accuracy& accuracy) { return accuracy.max_step; }
  static Search search(const settings::Accuracy& /*accuracy*/) { return {}; }
};

}  // namespace

std::unique_ptr<point::LineSolver> make_located(const LineRequest& request) {
  return compared::stepped_solver<Located>(request);
}

}  // namespace rubatlas::assembly

// `fixed`: classical Runge–Kutta in equal steps, a whole number of them in a revolution; contact by the sign
// of g in each stage, events nowhere. What people write first.

#include "compared/stepped_method.hpp"
#include "integrate/classical_runge_kutta.hpp"

namespace rubatlas::assembly {
namespace {

struct Fixed {
  using Table = integrate::ClassicalRungeKutta;
  using Search = compared::SolvedForce;
  static constexpr bool kAdaptive = false;
  static constexpr bool kLocated = false;

  static double largest_step(const settings::Accuracy& accuracy) { return accuracy.step; }
  static Search search(const settings::Accuracy& /*accuracy*/) { return {}; }
};

}  // namespace

std::unique_ptr<point::LineSolver> make_fixed(const LineRequest& request) {
  return compared::stepped_solver<Fixed>(request);
}

}  // namespace rubatlas::assembly

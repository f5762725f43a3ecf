// `hybrid`: closed-form flight, contacts by an order-8 pair, located events.

#include "integrate/dormand_prince_853.hpp"
#include "solve/hybrid_method.hpp"
#include "solve/typed_line_solver.hpp"

namespace rubatlas::solve {

std::unique_ptr<LineSolver> make_hybrid(const LineRequest& request) {
  return make_typed_line_solver<HybridMethod<integrate::DormandPrince853>>(request);
}

}  // namespace rubatlas::solve

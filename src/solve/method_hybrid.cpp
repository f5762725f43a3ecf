// `hybrid`: closed-form flight, contacts by an order-8 pair, located events.

#include "integrate/dormand_prince_853.hpp"
#include "solve/hybrid_method.hpp"
#include "solve/typed_motions.hpp"

namespace rubatlas::solve {

std::unique_ptr<LineSolver> make_hybrid(const LineRequest& request) {
  return make_paper_s_rotor<HybridMethod<integrate::DormandPrince853>>(request);
}

}  // namespace rubatlas::solve

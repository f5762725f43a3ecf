// `hybrid_54`: as `hybrid`, with a pair of order 5(4) in contact: what the order is worth.

#include "integrate/dormand_prince_54.hpp"
#include "solve/hybrid_method.hpp"
#include "solve/typed_motions.hpp"

namespace rubatlas::solve {

std::unique_ptr<LineSolver> make_hybrid_54(const LineRequest& request) {
  return make_paper_s_rotor<HybridMethod<integrate::DormandPrince54>>(request);
}

}  // namespace rubatlas::solve

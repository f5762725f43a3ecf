// `hybrid_32`: as `hybrid`, with a pair of order 3(2) in contact: what the order is worth.

#include "integrate/bogacki_shampine_32.hpp"
#include "solve/hybrid_method.hpp"
#include "solve/typed_motions.hpp"

namespace rubatlas::solve {

std::unique_ptr<LineSolver> make_hybrid_32(const LineRequest& request) {
  return make_paper_s_rotor<HybridMethod<integrate::BogackiShampine32>>(request);
}

}  // namespace rubatlas::solve

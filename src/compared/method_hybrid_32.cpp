// `hybrid_32`: as `hybrid`, with a pair of order 3(2) in contact: what the order is worth.

#include "assembly/hybrid_method.hpp"
#include "compared/paper_s_rotor.hpp"
#include "integrate/bogacki_shampine_32.hpp"
#include "motion/modes_of_axial_loads.hpp"
#include "motion/modes_of_rigid_blades.hpp"

namespace rubatlas::assembly {

std::unique_ptr<point::LineSolver> make_hybrid_32(const LineRequest& request) {
  return compared::make_paper_s_rotor<HybridMethod<integrate::BogackiShampine32>>(request);
}

}  // namespace rubatlas::assembly

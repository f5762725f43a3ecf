// `hybrid_54`: as `hybrid`, with a pair of order 5(4) in contact: what the order is worth.

#include "assembly/hybrid_method.hpp"
#include "compared/paper_s_rotor.hpp"
#include "integrate/dormand_prince_54.hpp"
#include "motion/modes_of_axial_loads.hpp"
#include "motion/modes_of_rigid_blades.hpp"

namespace rubatlas::assembly {

std::unique_ptr<point::LineSolver> make_hybrid_54(const LineRequest& request) {
  return compared::make_paper_s_rotor<HybridMethod<integrate::DormandPrince54>>(request);
}

}  // namespace rubatlas::assembly

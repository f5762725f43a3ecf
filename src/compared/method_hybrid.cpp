// `hybrid`: closed-form flight, contacts by an order-8 pair, located events.

#include "assembly/hybrid_method.hpp"
#include "compared/paper_s_rotor.hpp"
#include "integrate/dormand_prince_853.hpp"
#include "motion/modes_of_axial_loads.hpp"
#include "motion/modes_of_rigid_blades.hpp"

namespace rubatlas::assembly {

std::unique_ptr<point::LineSolver> make_hybrid(const LineRequest& request) {
  return compared::make_paper_s_rotor<HybridMethod<integrate::DormandPrince853>>(request);
}

}  // namespace rubatlas::assembly

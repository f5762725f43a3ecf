// `collocation`: as `hybrid`, with contacts of few blades solved by collocation. What is no such contact goes
// on in steps of the order-8 pair.

#include "assembly/hybrid_method.hpp"
#include "assembly/typed_motions.hpp"
#include "motion/collocation_and_steps.hpp"
#include "motion/modes_of_axial_loads.hpp"
#include "motion/modes_of_rigid_blades.hpp"

namespace rubatlas::assembly {

std::unique_ptr<point::LineSolver> make_collocation(const LineRequest& request) {
  return make_paper_s_rotor<HybridMethod<motion::CollocationAndSteps>>(request);
}

}  // namespace rubatlas::assembly

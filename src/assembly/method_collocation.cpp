// `collocation`: as `hybrid`, with contacts of one blade solved by collocation. What is no such contact goes
// on in steps of the order-8 pair.

#include "assembly/hybrid_method.hpp"
#include "assembly/typed_motions.hpp"
#include "integrate/dormand_prince_853.hpp"
#include "motion/modes_of_axial_loads.hpp"
#include "motion/modes_of_rigid_blades.hpp"

namespace rubatlas::assembly {
namespace {

struct CollocationAndSteps : integrate::DormandPrince853 {
  static constexpr bool kCollocates = true;
};

}  // namespace

std::unique_ptr<point::LineSolver> make_collocation(const LineRequest& request) {
  return make_paper_s_rotor<HybridMethod<CollocationAndSteps>>(request);
}

}  // namespace rubatlas::assembly

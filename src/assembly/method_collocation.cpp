// `collocation`: as `hybrid`, with contacts of one blade solved by collocation. What is no such contact goes
// on in steps of the order-8 pair.

#include "assembly/hybrid_method.hpp"
#include "assembly/typed_motions.hpp"
#include "integrate/dormand_prince_853.hpp"
#include "modes/collocated.hpp"
#include "motion/modes_of_axial_loads.hpp"
#include "motion/modes_of_rigid_blades.hpp"

namespace rubatlas {
namespace assembly {

struct CollocationAndSteps : integrate::DormandPrince853 {};

}  // namespace assembly

template <>
struct motion::CollocationOf<assembly::CollocationAndSteps> {
  static constexpr bool kOccurs = true;
  using Mode = modes::Collocated;
};

namespace assembly {

std::unique_ptr<point::LineSolver> make_collocation(const LineRequest& request) {
  return make_paper_s_rotor<HybridMethod<CollocationAndSteps>>(request);
}

}  // namespace assembly
}  // namespace rubatlas

// `hybrid_54` and `hybrid_32`: as `hybrid`, with a pair of lower order in contact: what the order is worth.

#include "assembly/methods.hpp"
#include "integrate/bogacki_shampine_32.hpp"
#include "integrate/dormand_prince_54.hpp"
#include "modes/modes_of_axial_loads.hpp"
#include "modes/modes_of_rigid_blades.hpp"

namespace rubatlas::assembly {
namespace {

template <class Pair>
std::unique_ptr<point::LineSolver> by_pair(const LineRequest& request) {
  if (request.line.contact.law == settings::ContactLaw::elastic_ring) {
    return hybrid_solver(request, modes::maker_of<modes::ModesOfRigidBlades<contact::CoulombFriction, Pair>>(
                                      contact::UnequalBlades(elastic_ring_of_blades(request.line))));
  }
  return hybrid_solver(request, modes::maker_of<modes::ModesOfAxialLoads<Pair>>(
                                    contact::UnequalBlades(elastica_of_blades(request))));
}

}  // namespace

std::unique_ptr<point::LineSolver> make_hybrid_54(const LineRequest& request) {
  return by_pair<integrate::DormandPrince54>(request);
}
std::unique_ptr<point::LineSolver> make_hybrid_32(const LineRequest& request) {
  return by_pair<integrate::BogackiShampine32>(request);
}

}  // namespace rubatlas::assembly

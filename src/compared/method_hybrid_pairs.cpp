// `hybrid_54` and `hybrid_32`: as `hybrid`, with a pair of lower order in contact: what the order is worth.

#include "assembly/methods.hpp"
#include "compared/phases_in_steps.hpp"
#include "integrate/bogacki_shampine_32.hpp"
#include "integrate/dormand_prince_54.hpp"

namespace rubatlas::assembly {

namespace {

template <class Pair>
std::unique_ptr<modes::ContactPhases> phases_of(const modes::ContactSetup& setup) {
  return compared::phases_in_steps(setup, integrate::tableau<Pair>());
}

}  // namespace

std::unique_ptr<point::LineSolver> make_hybrid_54(const LineRequest& request) {
  return hybrid_solver(request, phases_of<integrate::DormandPrince54>);
}
std::unique_ptr<point::LineSolver> make_hybrid_32(const LineRequest& request) {
  return hybrid_solver(request, phases_of<integrate::BogackiShampine32>);
}

}  // namespace rubatlas::assembly

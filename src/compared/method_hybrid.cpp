// `hybrid`: contacts in steps of order 8(5,3), of which all forces are solved for and all guards located: the
// oracle of collocation.

#include "assembly/methods.hpp"
#include "compared/phases_in_steps.hpp"
#include "integrate/dormand_prince_853.hpp"

namespace rubatlas::assembly {

std::unique_ptr<modes::ContactPhases> phases_in_steps(const modes::ContactSetup& setup) {
  return compared::phases_in_steps(setup, integrate::tableau<integrate::DormandPrince853>());
}

}  // namespace rubatlas::assembly

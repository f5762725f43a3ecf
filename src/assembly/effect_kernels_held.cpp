// The same, held beyond the ring until the force ends.

#include "assembly/effect_kernels.hpp"
#include "contact/elastica_contact.hpp"

namespace rubatlas::assembly {

std::unique_ptr<point::LineSolver> make_held_elastic_blades(const FamilyRequest& request) {
  return elastic_blades_in_any_ring<contact::Release::at_fold>(request);
}

}  // namespace rubatlas::assembly

// Elastic blades in a rigid ring or one that yields, released where the undeformed tip leaves it.

#include "assembly/effect_kernels.hpp"
#include "contact/elastica_contact.hpp"

namespace rubatlas::assembly {

std::unique_ptr<point::LineSolver> make_elastic_blades(const FamilyRequest& request) {
  return elastic_blades_in_any_ring<contact::Release::at_ring>(request);
}

}  // namespace rubatlas::assembly

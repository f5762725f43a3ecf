// Elastic blades in a rigid ring or one that yields, released where the undeformed tip leaves it.

#include "contact/elastica_contact.hpp"
#include "solve/effect_kernels.hpp"

namespace rubatlas::solve {

std::unique_ptr<LineSolver> elastic_blades_with_effects(const LineRequest& request) {
  return elastic_blades_in_any_ring<contact::Release::at_ring>(request);
}

}  // namespace rubatlas::solve

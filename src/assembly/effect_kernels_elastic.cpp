// Elastic blades in a rigid ring or one that yields, released where the undeformed tip leaves it.

#include "assembly/effect_families.hpp"
#include "assembly/elastic_blades_in_any_ring.hpp"

namespace rubatlas::assembly {

std::unique_ptr<point::LineSolver> make_elastic_blades(const FamilyRequest& request) {
  return elastic_blades_in_any_ring<contact::Release::at_ring>(request);
}

}  // namespace rubatlas::assembly

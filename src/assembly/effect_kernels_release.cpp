// Elastic blades that are released where their force ends.

#include "assembly/effect_families.hpp"
#include "assembly/elastic_blades_in_any_ring.hpp"

namespace rubatlas::assembly {

std::unique_ptr<point::LineSolver> make_elastic_blades_released_at_fold(const FamilyRequest& request) {
  return elastic_blades_in_any_ring<contact::Release::at_fold>(request);
}

}  // namespace rubatlas::assembly

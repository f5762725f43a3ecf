// Elastic blades that are released where their force ends.

#include "assembly/effect_kernels.hpp"
#include "contact/elastica_contact.hpp"

namespace rubatlas::assembly {

std::unique_ptr<point::LineSolver> make_elastic_blades_released_at_fold(const FamilyRequest& request) {
  return elastic_blades_in_any_ring<contact::Release::at_fold>(request);
}

}  // namespace rubatlas::assembly

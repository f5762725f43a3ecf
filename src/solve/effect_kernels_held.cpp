// The same, held beyond the ring until the force ends.

#include "contact/elastica_contact.hpp"
#include "solve/effect_kernels.hpp"

namespace rubatlas::solve {

std::unique_ptr<LineSolver> held_blades_with_effects(const LineRequest& request) {
  return elastic_blades_in_any_ring<contact::Release::at_fold>(request);
}

}  // namespace rubatlas::solve

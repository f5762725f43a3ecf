#include "modes/phases_in_steps.hpp"

#include "integrate/dormand_prince_853.hpp"

namespace rubatlas::modes {

std::unique_ptr<Phase> phase_in_853_steps(Form form, const ContactSetup& setup) {
  return phase_in_steps<integrate::DormandPrince853>(form, setup);
}

}  // namespace rubatlas::modes

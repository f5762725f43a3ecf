/// The phases in steps of a Runge–Kutta pair.
#pragma once

#include <memory>

#include "integrate/tableau.hpp"
#include "modes/contact_setup.hpp"

namespace rubatlas::compared {

std::unique_ptr<modes::Phase> phase_in_steps(modes::Form form, const modes::ContactSetup& setup,
                                             const integrate::Tableau& pair);

}  // namespace rubatlas::compared

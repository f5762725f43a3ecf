/// The phases in steps of a Runge–Kutta pair.
#pragma once

#include <memory>

#include "integrate/tableau.hpp"
#include "modes/phase.hpp"

namespace rubatlas::compared {

std::unique_ptr<modes::ContactPhases> phases_in_steps(const modes::ContactSetup& setup,
                                                      const integrate::Tableau& pair);

}  // namespace rubatlas::compared

/// The part of `explain` about effects: which are on, why, and what each costs.
#pragma once

#include "mpi/commands/explain_text.hpp"
#include "point/line_solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

/// Costs are measured as long as `go_on` says so.
void describe_effects(const settings::Scene& scene, const modes::GoOn& go_on, Text& text);

}  // namespace rubatlas::mpi

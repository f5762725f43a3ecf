/// What the observables of a scene cost, for `explain`.
#pragma once

#include "mpi/commands/explain_text.hpp"
#include "point/line_solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

/// Adds a section with one line for each observable: the share that it adds to the time of a sampled
/// revolution, measured as long as `go_on` returns true.
void describe_observables(const settings::Scene& scene, const modes::GoOn& go_on, Text& text);

}  // namespace rubatlas::mpi

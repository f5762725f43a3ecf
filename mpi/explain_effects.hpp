/// The part of `explain` about effects: which are on, why, and what each costs.
#pragma once

#include "mpi/explain_text.hpp"
#include "scene/scene.hpp"
#include "solve/line_solver.hpp"

namespace rubatlas::mpi {

/// Costs are measured as long as `go_on` says so.
void describe_effects(const scene::Scene& scene, const solve::GoOn& go_on, Text& text);

}  // namespace rubatlas::mpi

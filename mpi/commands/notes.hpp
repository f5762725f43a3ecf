/// Notes on a scene that a user should read before running it.
#pragma once

#include <string>
#include <vector>

#include "mpi/commands/estimate.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

/// Values that look like a typing error or a wrong unit, found from the scene alone. They do not stop a run.
/// One sentence each; empty where all values are plausible.
std::vector<std::string> doubts_about(const settings::Scene& scene);

/// For a scene in which every point has left the model's validity: the quantity of the scene that is the
/// cause; empty where it cannot be found.
std::string likely_reason_to_leave(const settings::Scene& scene);

/// One sentence each, the most important first; may be empty.
std::vector<std::string> notes_on(const settings::Scene& scene, const CostEstimate& cost);

}  // namespace rubatlas::mpi

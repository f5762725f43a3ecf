/// What a user should know about a scene before starting it.
#pragma once

#include <string>
#include <vector>

#include "mpi/commands/estimate.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

/// What looks like a slip of the pen or of a unit, from the scene alone; nothing of it stops a run. One
/// sentence each; empty where all is plausible.
std::vector<std::string> doubts_about(const settings::Scene& scene);

/// Where every point has left the model: what in the scene makes it do so, as far as that can be seen; empty
/// where it cannot.
std::string likely_reason_to_leave(const settings::Scene& scene);

/// One sentence each, the most important first; empty where there is nothing to say.
std::vector<std::string> notes_on(const settings::Scene& scene, const CostEstimate& cost);

}  // namespace rubatlas::mpi

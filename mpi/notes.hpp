/// What a user should know about a scene before starting it.
#pragma once

#include <string>
#include <vector>

#include "mpi/estimate.hpp"
#include "scene/scene.hpp"

namespace rubatlas::mpi {

/// One sentence each, the most important first; empty where there is nothing to say.
std::vector<std::string> notes_on(const scene::Scene& scene, const CostEstimate& cost);

}  // namespace rubatlas::mpi

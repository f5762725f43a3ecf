/// What a scene would compute and what it would cost, in words.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace rubatlas::mpi {

/// Effects on and off and why, kernel, grid, datasets, bytes and an estimate of the time. Runs a few of the
/// scene's points for about two seconds to make the estimate.
std::string explain(const scene::Scene& scene);

}  // namespace rubatlas::mpi

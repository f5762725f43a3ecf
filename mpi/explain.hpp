/// What a scene would compute and what it would cost, in words.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace rubatlas::mpi {

/// How long points are tried for an estimate [s], unless the user says otherwise.
inline constexpr double kEstimateSeconds = 2.0;

/// Effects on and off and why, kernel, grid, datasets, bytes and an estimate of the time, for which some of
/// the scene's points, one at least, run for about `measured_for` [s].
std::string explain(const scene::Scene& scene, double measured_for = kEstimateSeconds);

}  // namespace rubatlas::mpi

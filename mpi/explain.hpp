/// What a scene would compute and what it would cost, in words.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace rubatlas::mpi {

/// How long points are tried for an estimate [s], unless the user says otherwise.
inline constexpr double kEstimateSeconds = 1.6;

/// Effects on and off and why, kernel, grid, datasets, bytes, memory and an estimate of the time, for which
/// some of the scene's points run for about `measured_for` [s]. What cannot be measured in that time, or
/// counted, is said to be so: an answer takes as long for a grid of a billion points, and for motions that
/// take hours.
std::string explain(const scene::Scene& scene, double measured_for = kEstimateSeconds);

}  // namespace rubatlas::mpi

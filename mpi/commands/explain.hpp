/// What a scene would compute and what it would cost, in words.
#pragma once

#include <string>

#include "mpi/commands/estimate.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

/// How long `explain` measures [s], unless the user says otherwise; it answers within 3 s, the start of MPI
/// and the reading of a long scene included.
inline constexpr double kMeasuredSeconds = 2.0;

/// Effects on and off and why, kernel, grid, datasets, bytes, memory and an estimate of the time, for which
/// some of the scene's points are tried and its effects are timed, together for `measured_for` [s] at most.
/// What cannot be measured in that time, or counted, is said to be so: an answer takes as long for a grid of
/// a billion points, and for motions that take hours.
std::string explain(const settings::Scene& scene, double measured_for = kMeasuredSeconds,
                    const Clock& clock = seconds_on_the_wall);

}  // namespace rubatlas::mpi

/// `rubatlas orbit`: one point in full.
#pragma once

#include "mpi/commands/command_line.hpp"

namespace rubatlas::mpi {

/// Computes one point's motion and writes it. Returns the exit code: kSomePointsFailed when the motion did
/// not end as done. Throws SceneError, UsageError or EnvironmentError.
int compute_orbit(const OrbitCommand& command);

}  // namespace rubatlas::mpi

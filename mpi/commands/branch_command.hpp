/// `rubatlas branch`: periodic orbits followed along a quantity, stable or not.
#pragma once

#include "mpi/commands/command_line.hpp"

namespace rubatlas::mpi {

/// Follows the branch and writes it. Returns the exit code. Throws SceneError, UsageError or
/// EnvironmentError.
int follow_branch(const BranchCommand& command);

}  // namespace rubatlas::mpi

/// `rubatlas accuracy`: what accuracy costs in time.
#pragma once

#include "mpi/commands/command_line.hpp"

namespace rubatlas::mpi {

/// Runs the study on this process and writes it. Returns the exit code: kSomePointsFailed when a run did not
/// end as done. Throws SceneError, UsageError or EnvironmentError.
int compute_accuracy(const AccuracyCommand& command);

}  // namespace rubatlas::mpi

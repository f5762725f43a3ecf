/// From an exception to the message on standard error and the exit code.
#pragma once

#include <exception>

namespace rubatlas::mpi {

/// Prints "rubatlas: ..." and returns the exit code of this kind of failure. Kinds of failure are mapped to
/// exit codes here only: a mistake in the scene or the call is kUsage, everything else is kEnvironment.
int report_failure(const std::exception_ptr& failure);

}  // namespace rubatlas::mpi

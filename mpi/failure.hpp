/// From whatever was thrown to the message on standard error and the exit code.
#pragma once

#include <exception>

namespace rubatlas::mpi {

/// Prints "rubatlas: ..." and returns the exit code of this kind of failure. The one place that maps kinds to
/// codes: a mistake in scene or call is kUsage, everything else is the environment's.
int report_failure(const std::exception_ptr& failure);

}  // namespace rubatlas::mpi

/// `rubatlas verify ATLAS [--recompute N]`: are the rows of an atlas what was computed?
#pragma once

#include "mpi/commands/command_line.hpp"

namespace rubatlas::mpi {

/// Checks all that is not a row against the header's checksum, every finished row against its own, and
/// computes some rows again, each from the end of the point before it, as a run that resumes there would.
/// Says on standard output what was found right, on standard error what was not. Returns the exit code:
/// kEnvironment where anything is not as it was computed.
int verify(const VerifyCommand& command);

}  // namespace rubatlas::mpi

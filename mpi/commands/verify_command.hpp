/// `rubatlas verify ATLAS [--recompute N]`: whether the rows of an atlas are those that were computed.
#pragma once

#include "mpi/commands/command_line.hpp"

namespace rubatlas::mpi {

/// Compares everything except the rows with the header's checksum, and every finished row with its own.
/// Computes some rows again, each from the final state of the point before it, as a resumed run would. Prints
/// confirmations on standard output and differences on standard error. Returns the exit code: kEnvironment
/// where anything differs.
int verify(const VerifyCommand& command);

}  // namespace rubatlas::mpi

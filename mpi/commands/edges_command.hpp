/// `rubatlas edges`: the borders between motions that an atlas shows, narrowed down by new points.
#pragma once

#include "mpi/commands/command_line.hpp"

namespace rubatlas::mpi {

/// Computes the edges of an atlas on all ranks, writes them, and returns the exit code of this rank: 10 when
/// points could not be integrated, 75 when it was stopped, in which case nothing is written. Initialises MPI
/// only when started by mpirun.
int find_edges(const EdgesCommand& command);

}  // namespace rubatlas::mpi

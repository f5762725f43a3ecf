/// Being asked to stop: SIGUSR1 (which mpirun passes on to every rank), SIGTERM and SIGINT.
///
/// The point that is being computed is finished and written; then the job ends as resumable. A second SIGTERM
/// or SIGINT ends the process at once, which the atlas survives too.
#pragma once

namespace rubatlas::mpi {

/// From here on the three signals are noted and do nothing else.
void note_stop_signals();

/// True when one of them has come.
bool stop_requested();

}  // namespace rubatlas::mpi

/// Being asked to stop: SIGUSR1 (which mpirun passes on to every rank), SIGTERM, SIGINT and SIGHUP.
///
/// The points that are being computed are given up and stay pending; the job ends as resumable. A second
/// signal ends the process at once, which the atlas survives too.
#pragma once

namespace rubatlas::mpi {

/// From here on the first of these signals is noted and does nothing else. A pipe that nobody reads any more
/// (progress to a viewer that has been closed) is an error of writing instead of a signal.
void note_stop_signals();

/// True when one of them has come.
bool stop_requested();

}  // namespace rubatlas::mpi

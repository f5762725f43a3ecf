/// Signals that ask the job to stop: SIGUSR1 (which mpirun passes on to every rank), SIGTERM, SIGINT and
/// SIGHUP.
///
/// The points that are being computed are given up and stay pending; the job ends as resumable. A second
/// signal ends the process at once, which leaves a valid atlas too.
#pragma once

namespace rubatlas::mpi {

/// From now on the first of these signals is recorded and has no other effect. Writing to a pipe whose reader
/// has gone fails instead of raising a signal.
void note_stop_signals();

/// True when one of these signals has been received.
bool stop_requested();

}  // namespace rubatlas::mpi

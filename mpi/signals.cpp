#include "mpi/signals.hpp"

#include <csignal>

namespace rubatlas::mpi {
namespace {

/// The only state that a signal handler may touch.
volatile std::sig_atomic_t stop_was_requested = 0;

void note(int /*signal*/) {
  stop_was_requested = 1;
}

void handle(int signal, int flags) {
  struct sigaction action {};
  action.sa_handler = note;
  // Interrupted system calls go on: a row that is being written is written.
  action.sa_flags = SA_RESTART | flags;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

}  // namespace

void note_stop_signals() {
  handle(SIGUSR1, 0);
  handle(SIGTERM, static_cast<int>(SA_RESETHAND));
  handle(SIGINT, static_cast<int>(SA_RESETHAND));
}

bool stop_requested() {
  return stop_was_requested != 0;
}

}  // namespace rubatlas::mpi

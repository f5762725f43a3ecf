#include "mpi/job/signals.hpp"

#include <array>
#include <csignal>
#include <ctime>

namespace rubatlas::mpi {
namespace {

/// The first signal received; the only state that the signal handler shares with the program.
volatile std::sig_atomic_t stop_signal = 0;

/// Time of the first signal; used by the handler only.
timespec first_time{};

/// Signals within this time [s] count as one request, since `timeout`, for example, sends each signal twice.
constexpr double kOneRequest = 0.2;

double seconds_since_the_first() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec - first_time.tv_sec) +
         1e-9 * static_cast<double>(now.tv_nsec - first_time.tv_nsec);
}

void note(int signal) {
  if (stop_signal == 0) {
    clock_gettime(CLOCK_MONOTONIC, &first_time);
    stop_signal = signal;
  } else if (seconds_since_the_first() > kOneRequest) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);  // the signal is delivered when this handler returns
  }
}

}  // namespace

void note_stop_signals() {
  constexpr std::array kStopSignals{SIGUSR1, SIGTERM, SIGINT, SIGHUP};
  for (const int signal : kStopSignals) {
    struct sigaction action {};
    // A signal that `nohup`, or a shell that starts a background job, has set to be ignored stays ignored.
    if (sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) continue;
    action.sa_handler = note;
    // Interrupted system calls are restarted, so that a row that is being written is completed.
    action.sa_flags = SA_RESTART;
    sigfillset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
  std::signal(SIGPIPE, SIG_IGN);
}

bool stop_requested() {
  return stop_signal != 0;
}

}  // namespace rubatlas::mpi

/// The clocks with which the program measures time.
#pragma once

#include <chrono>
#include <ctime>

namespace rubatlas::mpi {

/// Time [s] of a clock that is never set back.
inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// CPU time of this process [s]; other processes on the machine do not count.
inline double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace rubatlas::mpi

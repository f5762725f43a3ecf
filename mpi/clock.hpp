/// What time is measured with.
#pragma once

#include <chrono>
#include <ctime>

namespace rubatlas::mpi {

/// [s], on a clock that nobody sets.
inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// CPU time of this process [s], so that what else runs on the machine does not count.
inline double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace rubatlas::mpi

/// How the program ends, and the one exception that is about how it was called.
#pragma once

#include <stdexcept>

namespace rubatlas::mpi {

namespace exit_code {
// 1 is no code of ours: it is what mpirun returns for a job that it has ended itself.
constexpr int kDone = 0;               ///< every point was computed; some may have left the model's validity
constexpr int kUsage = 2;              ///< usage or scene error
constexpr int kEnvironment = 3;        ///< I/O or environment
constexpr int kSomePointsFailed = 10;  ///< every point was computed, some could not be integrated
constexpr int kInterrupted = 75;       ///< stopped on request, resumable
}  // namespace exit_code

/// A call that cannot be carried out as given (existing file without a flag, another scene's atlas): exit
/// code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace rubatlas::mpi

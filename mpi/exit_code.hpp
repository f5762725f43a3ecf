/// The exit codes of the program, and the exception for a call that cannot be carried out.
#pragma once

#include <stdexcept>

namespace rubatlas::mpi {

namespace exit_code {
// The program never returns 1, which mpirun returns for a job that mpirun has ended.
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

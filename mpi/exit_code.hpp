/// How the program ends, and the one exception that is about how it was called.
#pragma once

#include <stdexcept>

namespace rubatlas::mpi {

namespace exit_code {
constexpr int kDone = 0;
constexpr int kSomePointsFailed = 1;  ///< done, but some points have a status other than done
constexpr int kUsage = 2;             ///< usage or scene error
constexpr int kEnvironment = 3;       ///< I/O or environment
constexpr int kInterrupted = 75;      ///< stopped on request, resumable
}  // namespace exit_code

/// A call that cannot be carried out as given (existing file without a flag, another scene's atlas): exit
/// code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace rubatlas::mpi

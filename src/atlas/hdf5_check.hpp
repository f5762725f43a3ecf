/// How a failing HDF5 call becomes an `EnvironmentError`; only for the sources of this folder.
///
/// The message names the file, the dataset and the reason that the system gave. The sentences of HDF5, its
/// calls and their places in our sources do not help a user and are left out.
#pragma once

#include <fmt/format.h>
#include <hdf5.h>

#include <string>
#include <utility>

#include "atlas/environment_error.hpp"

namespace rubatlas::atlas {

/// A call that failed; the text is the system's reason ("No space left on device"), or that the system gave
/// none. `about` adds file and dataset.
class Hdf5Failure : public EnvironmentError {
 public:
  using EnvironmentError::EnvironmentError;
};

/// Throws Hdf5Failure and clears HDF5's error stack.
[[noreturn]] void throw_hdf5_failure();

/// Keeps HDF5 from printing its error stack and from installing an exit handler (which hangs a parallel job
/// that ends with a file open). Called before the first use.
void prepare_hdf5();

/// The value of an HDF5 call. Throws Hdf5Failure.
template <typename Result>
Result check_hdf5(Result result) {
  if (result < 0) throw_hdf5_failure();
  return result;
}

/// "FILE: /name" of anything that HDF5 has open.
std::string described(hid_t identifier);

/// Makes HDF5 calls on an open object; a failure becomes "FILE: /name cannot be <deed>: reason".
template <typename Calls>
auto about(hid_t identifier, const char* deed, const Calls& calls) {
  try {
    return calls();
  } catch (const Hdf5Failure& failure) {
    throw EnvironmentError(fmt::format("{} cannot be {}: {}", described(identifier), deed, failure.what()));
  }
}

}  // namespace rubatlas::atlas

/// The value of an HDF5 call, or an exception.
#define RUBATLAS_HDF5(call) ::rubatlas::atlas::check_hdf5((call))

/// How a failing HDF5 call becomes an `EnvironmentError`; only for the sources of this folder.
#pragma once

#include <hdf5.h>

#include <string>

namespace rubatlas::atlas {

/// Throws with HDF5's innermost reason and clears HDF5's error stack.
[[noreturn]] void throw_hdf5_error(const char* expression, const char* file, int line);

/// Keeps HDF5 from printing its error stack and from installing an exit handler (which hangs a parallel job
/// that ends with a file open). Called before the first use.
void prepare_hdf5();

template <typename Result>
Result check_hdf5(Result result, const char* expression, const char* file, int line) {
  if (result < 0) throw_hdf5_error(expression, file, line);
  return result;
}

}  // namespace rubatlas::atlas

/// The value of an HDF5 call, or an exception that names the call.
#define RUBATLAS_HDF5(call) ::rubatlas::atlas::check_hdf5((call), #call, __FILE__, __LINE__)

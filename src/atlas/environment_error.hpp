/// A broken environment: the disk, the file system, HDF5 or MPI refused. The program ends with exit code 3.
#pragma once

#include <stdexcept>

namespace rubatlas::atlas {

class EnvironmentError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace rubatlas::atlas

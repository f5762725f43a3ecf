/// Version and build of this program.
#pragma once

#include <string>

#include "atlas/software.hpp"

namespace rubatlas::mpi {

/// Version, commit and compiler, as every file of this program names them.
const atlas::Software& software();

/// What `rubatlas --version` prints: the build and the libraries that it was made with.
std::string version_text();

}  // namespace rubatlas::mpi

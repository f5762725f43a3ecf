/// Copies of atlases that a user may stop.
#pragma once

#include <span>

#include "atlas/copy.hpp"

namespace rubatlas::mpi {

/// Replaces an atlas only where no run is filling it. A signal that asks the program to stop (`signals.hpp`)
/// ends the copy; the result is then false, a sentence has been printed, and nothing is left on the disk.
/// Throws atlas::EnvironmentError.
bool copy_unless_stopped(const atlas::Output& output, const atlas::AtlasHeader& header,
                         atlas::RowStorage storage, std::span<const atlas::RowSource> sources);

}  // namespace rubatlas::mpi

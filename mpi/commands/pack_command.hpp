/// `rubatlas pack ATLAS.h5 -o PACKED.h5`: a smaller copy, for the archive.
#pragma once

#include "mpi/commands/command_line.hpp"

namespace rubatlas::mpi {

/// Copies an atlas into compressed chunks, reads the copy again and compares all rows with their checksums.
/// The copy is an atlas for every reader; no run goes on with it. Prints both sizes. Throws
/// atlas::OutputRefusal or atlas::EnvironmentError, and has then written nothing.
int pack(const PackCommand& command);

}  // namespace rubatlas::mpi

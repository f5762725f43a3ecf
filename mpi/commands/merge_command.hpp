/// `rubatlas merge A.h5 B.h5 ... -o C.h5`: the parts of an atlas become one.
#pragma once

#include "mpi/commands/command_line.hpp"

namespace rubatlas::mpi {

/// Copies the rows of parts (`run --part`) of one scene into an atlas that has the bytes of a single run. A
/// part that is missing or not complete leaves its points pending, for `run --resume` to compute; sentences
/// on standard error say which. Returns the exit code that a run would have left with this atlas. Throws
/// UsageError, atlas::OutputRefusal or atlas::EnvironmentError, and has then written nothing.
int merge(const MergeCommand& command);

}  // namespace rubatlas::mpi

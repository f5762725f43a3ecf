/// Command `status`: how many points of an atlas are computed.
#pragma once

#include <string>

#include "atlas/atlas_reader.hpp"
#include "mpi/job/progress.hpp"

namespace rubatlas::mpi {

/// Of the points that the atlas is for: those of its part. Reads the atlas itself, however the runs that
/// filled it ended. Throws EnvironmentError.
Standing standing_of_atlas(const atlas::AtlasReader& atlas);

/// One sentence for people.
std::string status_sentence(const atlas::AtlasReader& atlas, const Standing& standing);

}  // namespace rubatlas::mpi

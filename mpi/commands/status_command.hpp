/// Command `status`: how many points of an atlas are computed.
#pragma once

#include <filesystem>
#include <string>

#include "mpi/job/progress.hpp"

namespace rubatlas::mpi {

/// Reads the atlas itself, however the runs that filled it ended. Throws EnvironmentError.
Standing standing_of_atlas(const std::filesystem::path& atlas);

/// One sentence for people.
std::string status_sentence(const std::filesystem::path& atlas, const Standing& standing);

}  // namespace rubatlas::mpi

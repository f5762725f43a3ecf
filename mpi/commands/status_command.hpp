/// Command `status`: how far an atlas is.
#pragma once

#include <filesystem>
#include <string>

#include "mpi/job/progress.hpp"

namespace rubatlas::mpi {

/// Of the atlas itself, whoever has filled it and however that ended. Throws EnvironmentError.
Standing standing_of_atlas(const std::filesystem::path& atlas);

/// One sentence for people.
std::string status_sentence(const std::filesystem::path& atlas, const Standing& standing);

}  // namespace rubatlas::mpi

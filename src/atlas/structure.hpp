/// Whether a file is the atlas that its scene asks for: the one check of all who read atlases.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "atlas/hdf5.hpp"
#include "plan/grid.hpp"

namespace rubatlas::atlas {

/// Compares kind, shape and scales of every dataset with what the atlas' own scene asks for, its axes with
/// the scene's grid, and looks at what readers rely on: statuses are known, and points that are done have
/// finite final states. Returns the axes. Throws EnvironmentError with one sentence that names the file and
/// the first departure.
std::vector<plan::Axis> require_atlas(const File& file, const std::string& path);

/// Opens an atlas to be examined. HDF5 crashes on some files that are damaged or made to be: where the header
/// does not have its checksum a process of its own examines the file first. Throws EnvironmentError.
File open_with_care(const std::filesystem::path& path);

/// Layout of this file is the one without checksums.
bool lacks_checksums(const File& file);

}  // namespace rubatlas::atlas

/// Checks that a file is the atlas that its scene requires. Every reader of atlases uses this check.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "atlas/hdf5.hpp"
#include "plan/grid.hpp"
#include "plan/part.hpp"

namespace rubatlas::atlas {

/// Compares kind, shape and scales of every dataset with those that the scene of the atlas requires, and the
/// axes with the scene's grid. Checks also that every status is a known one, and that points that are done
/// have finite final states, since readers rely on both. Returns the axes. Throws EnvironmentError with one
/// sentence that names the file and the first departure.
std::vector<plan::Axis> require_atlas(const File& file, const std::string& path);

/// The part of its scene's grid that an atlas is for. Throws EnvironmentError where its mark is none.
plan::Part require_part(const File& file, const std::string& path, const std::vector<plan::Axis>& axes);

/// A file that is sound, and of another kind than the command reads: one sentence, exit code 2.
class WrongFile : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Opens an atlas. HDF5 crashes on some files that are damaged, by accident or on purpose. Where the header
/// does not match its checksum, a separate process therefore examines the file first. Throws
/// EnvironmentError, and WrongFile.
File open_with_care(const std::filesystem::path& path);

/// The scene with every default written out, as this version writes it.
std::string resolved_scene(const File& file);

/// True when the file has the layout without checksums.
bool lacks_checksums(const File& file);

}  // namespace rubatlas::atlas

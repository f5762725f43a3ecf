/// MAPS.h5: the classes on the axes of the atlas, the table of regions and triggers, and the texts.
///
/// The layout is in the README of this folder, "MAPS.h5".
#pragma once

#include <filesystem>
#include <string>

#include "analysis/findings.hpp"
#include "atlas/atlas_reader.hpp"

namespace rubatlas::analysis {

/// Writes the file under another name and renames it when it is complete. `atlas_name` is kept as an
/// attribute. Throws atlas::EnvironmentError.
void write_maps(const std::filesystem::path& path, const Findings& found, const atlas::AtlasReader& atlas,
                const std::string& atlas_name);

}  // namespace rubatlas::analysis

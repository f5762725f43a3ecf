/// EDGES.h5: the edges of an atlas, one row each.
///
/// The layout is in maps.md, "EDGES.h5".
#pragma once

#include <filesystem>
#include <string>

#include "analysis/findings.hpp"
#include "atlas/atlas_reader.hpp"
#include "atlas/output.hpp"
#include "atlas/software.hpp"

namespace rubatlas::analysis {

/// Creates the group `/edges` in a new file, in that of the edges or of the maps. `found.edges` is there.
void create_edges(atlas::File& file, const Findings& found);

/// `atlas_name` is kept as an attribute. Throws atlas::EnvironmentError.
void write_edges(const atlas::Output& output, const Findings& found, const atlas::AtlasReader& atlas,
                 const std::string& atlas_name, const atlas::Software& software);

/// The edges that were computed for an atlas whose findings are `found`. Throws atlas::EnvironmentError where
/// the file cannot be read, settings::SceneError where it is no file of edges, or of another atlas.
EdgeTable read_edges(const std::filesystem::path& path, const Findings& found,
                     const atlas::AtlasReader& atlas);

}  // namespace rubatlas::analysis

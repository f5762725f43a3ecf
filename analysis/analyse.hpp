/// `rubatlas analyse ATLAS.h5 -o MAPS.h5 [--table TABLE.md]`: from an atlas to its classes, regions,
/// triggers and sensitivities.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "analysis/displacement_limit.hpp"
#include "analysis/findings.hpp"
#include "atlas/atlas_reader.hpp"

namespace rubatlas::analysis {

/// Applies the rules of this folder's README to an atlas. The atlas may be incomplete; points that are not
/// done are left out. `limit`: the displacement before which signs in the spectrum are looked for.
Findings examine(const atlas::AtlasReader& atlas, const DisplacementLimit& limit = {});

/// Returns the result as text, writes MAPS.h5 and, where asked, the Markdown table, each
/// completely or not at all; with `overwrite` they replace older ones. Throws atlas::EnvironmentError when a
/// file cannot be read or written, or a row of the atlas does not match its checksum; atlas::OutputRefusal
/// when an output exists and must not be replaced. `edges`: a file of the atlas's edges (`edges_file.hpp`),
/// which the table then quotes with their uncertainty, and the maps contain.
std::string analyse(const std::filesystem::path& atlas, const std::filesystem::path& maps,
                    const std::optional<std::filesystem::path>& table, bool overwrite,
                    const std::optional<std::filesystem::path>& edges = std::nullopt,
                    const DisplacementLimit& limit = {});

/// Enters the edges of an atlas into its findings.
void enter_edges(Findings& found, EdgeTable edges);

}  // namespace rubatlas::analysis

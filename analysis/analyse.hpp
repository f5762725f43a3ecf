/// `rubatlas analyse ATLAS.h5 -o MAPS.h5 [--table TABLE.md]`: from an atlas to its classes, regions,
/// triggers, sensitivities and the verdict on the paper's statements.
#pragma once

#include <filesystem>
#include <optional>

#include "analysis/findings.hpp"
#include "atlas/atlas_reader.hpp"

namespace rubatlas::analysis {

/// Applies the rules of this folder's README to an atlas, which may be incomplete: rows that are not done
/// count as not being there.
Findings examine(const atlas::AtlasReader& atlas);

/// Prints the result on the standard output, writes MAPS.h5 and, where asked, the Markdown table, each as a
/// whole or not at all; `overwrite`: in place of older ones. Throws atlas::EnvironmentError when a file
/// cannot be read or written, or a row of the atlas does not have its checksum; atlas::OutputRefusal when
/// something stands where the outputs are to go.
void analyse(const std::filesystem::path& atlas, const std::filesystem::path& maps,
             const std::optional<std::filesystem::path>& table, bool overwrite);

}  // namespace rubatlas::analysis

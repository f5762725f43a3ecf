/// MAPS.h5: the classes on the axes of the atlas, the table of regions and triggers, and the texts.
///
/// The layout is in the page maps.md, "MAPS.h5".
#pragma once

#include <string>

#include "analysis/findings.hpp"
#include "atlas/atlas_reader.hpp"
#include "atlas/output.hpp"

namespace rubatlas::analysis {

/// `atlas_name` is kept as an
/// attribute. Throws atlas::EnvironmentError.
void write_maps(const atlas::Output& output, const Findings& found, const atlas::AtlasReader& atlas,
                const std::string& atlas_name);

}  // namespace rubatlas::analysis

/// Whether the rows of an atlas are what was written: every finished row against its checksum.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "atlas/atlas_reader.hpp"

namespace rubatlas::atlas {

/// Finished points (status other than pending) whose row does not have its checksum, ascending. Reads all
/// rows. `atlas` has checksums. Throws EnvironmentError.
std::vector<std::size_t> damaged_rows(const AtlasReader& atlas);

/// CRC-32 of what a point stores in one dataset.
std::uint32_t stored_checksum(const AtlasReader& atlas, const std::string& dataset, std::size_t point);

/// "the row at speed_ratio=0.3 does not have its checksum".
std::string damage_of(const AtlasReader& atlas, std::size_t point);

/// Throws EnvironmentError with one sentence where a finished row is damaged. An atlas without checksums
/// passes.
void require_sound_rows(const AtlasReader& atlas);
void require_sound_row(const AtlasReader& atlas, std::size_t point);

}  // namespace rubatlas::atlas

/// Compares the finished rows of an atlas with their checksums.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "atlas/atlas_reader.hpp"

namespace rubatlas::atlas {

/// Finished points (status other than pending) whose row does not match its checksum, ascending. Reads all
/// rows. The atlas has to have checksums. Throws EnvironmentError.
std::vector<std::size_t> damaged_rows(const AtlasReader& atlas);

/// CRC-32 of the values of a point in one dataset.
std::uint32_t stored_checksum(const AtlasReader& atlas, const std::string& dataset, std::size_t point);

/// "the row at speed_ratio=0.3 does not have its checksum".
std::string damage_of(const AtlasReader& atlas, std::size_t point);

/// Throws EnvironmentError with one sentence where a finished row is damaged. An atlas without checksums
/// passes.
void require_sound_rows(const AtlasReader& atlas);
void require_sound_row(const AtlasReader& atlas, std::size_t point);

}  // namespace rubatlas::atlas

/// The checksum of all that is in an atlas besides its rows: axes, texts, attributes, and HDF5's own
/// structure.
///
/// None of it changes after creation, so its bytes have one CRC-32. It stands in the root attribute
/// `header_checksum` behind a mark that can be found without HDF5, which crashes on some damaged files: 16
/// bytes of mark, the CRC-32, the number of ranges (u32 each), and the ranges of bytes that belong to rows
/// (begin and end, u64). It covers every byte of the file but those of the ranges, its own four, and HDF5's
/// flags of open files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "atlas/hdf5.hpp"

namespace rubatlas::atlas {

/// Creates the attribute, to be the first of a new file: the mark must not be far behind its beginning.
void create_header_checksum(Object root, std::size_t row_dataset_count);

/// Computes and writes the checksum: the last act of creation, on a closed file. Throws EnvironmentError.
void seal_header(const std::filesystem::path& atlas);

enum class Header : std::uint8_t { sound, damaged, without_checksum };
/// Looks at bytes only. A file that cannot be read is without checksum.
Header header_of(const std::filesystem::path& atlas);

/// Empty, or a sentence that names the file and says that something besides its rows has changed since it was
/// created.
std::string header_damage(const std::filesystem::path& atlas);

}  // namespace rubatlas::atlas

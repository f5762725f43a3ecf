/// The checksum of everything in an atlas except its rows: axes, texts, attributes, and the internal
/// structure of HDF5.
///
/// These bytes never change after creation, so that one CRC-32 covers them. It is stored in the root
/// attribute `header_checksum`. The attribute begins with a mark by which it can be found without HDF5, since
/// HDF5 crashes on some damaged files: 16 bytes of mark, the CRC-32, the number of ranges (u32 each), and the
/// ranges of bytes that belong to rows (begin and end, u64). The CRC-32 covers every byte of the file except
/// those of the ranges, its own four, and the flags by which HDF5 marks open files. A packed atlas takes no
/// more rows; it has no ranges, and the CRC-32 covers its rows too.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "atlas/hdf5.hpp"

namespace rubatlas::atlas {

/// Creates the attribute. It has to be the first object of a new file, because the mark is looked for near
/// the beginning of the file only.
void create_header_checksum(Object root, std::size_t row_dataset_count);

/// Computes and writes the checksum: the last act of creation, on a closed file. Throws EnvironmentError.
void seal_header(const std::filesystem::path& atlas);

enum class Header : std::uint8_t { sound, damaged, without_checksum };
/// Reads the bytes without HDF5. A file that cannot be read counts as one without checksum.
Header header_of(const std::filesystem::path& atlas);

/// Empty, or a sentence that names the file and says that something besides its rows has changed since it was
/// created, or anything at all in a packed atlas.
std::string header_damage(const std::filesystem::path& atlas);

}  // namespace rubatlas::atlas

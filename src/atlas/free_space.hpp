/// Checks, before the first point is computed, that the disk has room for an atlas.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace rubatlas::atlas {

/// Throws EnvironmentError, with both numbers, when a file that occupies `bytes` does not fit where `path` is
/// or would be, or when its length exceeds the process's own limit. What the file at `path` occupies already
/// counts as room. `made_of`: a phrase for the message that says of what these bytes consist. `length`: of a
/// file with holes, which is longer than what it occupies.
void require_space(const std::filesystem::path& path, std::uint64_t bytes, std::string_view made_of = {},
                   std::uint64_t length = 0);

/// "3.2 GB": three digits and a decimal unit.
std::string readable_bytes(std::uint64_t bytes);

}  // namespace rubatlas::atlas

/// Is there room for an atlas before the first point is computed?
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace rubatlas::atlas {

/// Throws EnvironmentError, with both numbers, when a file of `bytes` does not fit where `path` is or would
/// be, or exceeds the process's own limit. What the file at `path` occupies already counts as room.
/// `made_of`: how they come about, a phrase for the message.
void require_space(const std::filesystem::path& path, std::uint64_t bytes, std::string_view made_of = {});

/// "3.2 GB": three digits and a decimal unit.
std::string readable_bytes(std::uint64_t bytes);

}  // namespace rubatlas::atlas

/// A file appears under its name when it is complete, or not at all.
#pragma once

#include <filesystem>

namespace rubatlas::atlas {

/// The name under which a file is written before it is published; in the same directory, since a rename must
/// not cross file systems.
std::filesystem::path unpublished_name(const std::filesystem::path& path);

/// Brings a closed file to the disk and renames it from `unpublished_name(path)` to `path`, replacing what
/// stood there. Throws EnvironmentError.
void publish(const std::filesystem::path& path);

}  // namespace rubatlas::atlas

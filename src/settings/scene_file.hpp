/// The text of a scene file.
#pragma once

#include <filesystem>
#include <string>

namespace rubatlas::settings {

/// The file's text, unchanged. Throws SceneError when the file is missing or unreadable.
std::string read_text(const std::filesystem::path& path);

}  // namespace rubatlas::settings

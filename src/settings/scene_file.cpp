#include "settings/scene_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include "settings/reader.hpp"

namespace rubatlas::settings {

std::string read_text(const std::filesystem::path& path) {
  constexpr std::size_t kLongestScene = std::size_t{64} << 20U;  // [bytes], far above any scene
  const auto refuse = [&](std::string_view why) {
    throw SceneError(fmt::format("cannot read the scene {}: {}", path.string(), why));
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) refuse("it is a directory");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) refuse(std::strerror(errno));
  std::string text;
  std::vector<char> block(std::size_t{1} << 16U);
  while (const auto size = std::fread(block.data(), 1, block.size(), file.get())) {
    text.append(block.data(), size);
    if (text.size() > kLongestScene) refuse("it is longer than 64 MiB");
  }
  if (std::ferror(file.get()) != 0) refuse(std::strerror(errno));
  // Some editors begin a text in UTF-8 with this mark, which is no part of JSON.
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  return text;
}

}  // namespace rubatlas::settings

#include "atlas/output.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

#include "atlas/environment_error.hpp"
#include "atlas/hdf5.hpp"
#include "atlas/header_checksum.hpp"

namespace rubatlas::atlas {
namespace {

struct Kind {
  FileKind kind;
  const char* word;
  const char* words;
  const char* dataset;  ///< a dataset that only this kind has, for files whose root has no attribute `kind`
};

constexpr std::array kKinds{Kind{FileKind::accuracy, "accuracy", "a study of accuracy", "/setting"},
                            Kind{FileKind::atlas, "atlas", "an atlas", "/final_state"},
                            Kind{FileKind::branch, "branch", "a branch", "/multipliers"},
                            Kind{FileKind::maps, "maps", "maps", "/class"},
                            Kind{FileKind::edges, "edges", "edges", nullptr},
                            Kind{FileKind::orbit, "orbit", "an orbit", "/sections"},
                            Kind{FileKind::table, "table", "a table", nullptr},
                            Kind{FileKind::record, "record", "a record of runs", nullptr}};

const Kind& entry(FileKind kind) {
  for (const auto& known : kKinds) {
    if (known.kind == kind) return known;
  }
  return kKinds.front();
}

std::optional<FileKind> kind_of_hdf5(const std::filesystem::path& path) {
  if (header_of(path) == Header::damaged) return std::nullopt;
  try {
    const File file = File::open_to_read(path);
    const Object root = file.root();
    if (!root.has_attribute("software") || root.text("software") != "rubatlas") return std::nullopt;
    const std::string word = root.has_attribute("kind") ? root.text("kind") : "";
    for (const auto& known : kKinds) {
      if (word.empty() ? known.dataset != nullptr && file.has(known.dataset) : word == known.word) {
        return known.kind;
      }
    }
  } catch (const EnvironmentError&) {  // no file of this program
  }
  return std::nullopt;
}

std::string first_line(const std::filesystem::path& path) {
  std::string line(64, '\0');  // longer than the marks; of a file without line ends no more is read
  std::ifstream file(path, std::ios::binary);
  file.read(line.data(), static_cast<std::streamsize>(line.size()));
  line.resize(static_cast<std::size_t>(file.gcount()));
  return line.substr(0, line.find('\n'));
}

/// Where the links of a path lead.
std::filesystem::path followed(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_symlink(path, error)) return path;
  auto target = std::filesystem::canonical(path, error);
  if (error) {
    throw OutputRefusal(
        fmt::format("{} is a link that leads to no file: {}", path.string(), error.message()));
  }
  return target;
}

/// The same file, or the same place for one that is not there yet.
bool is_same(const std::filesystem::path& one, const std::filesystem::path& other) {
  std::error_code error;
  if (std::filesystem::exists(one, error) || std::filesystem::exists(other, error)) {
    return std::filesystem::equivalent(one, other, error);  // device and inode, links followed
  }
  return std::filesystem::weakly_canonical(one, error) == std::filesystem::weakly_canonical(other, error);
}

const char* what_else(std::filesystem::file_type type) {
  switch (type) {
    case std::filesystem::file_type::directory:
      return "a directory";
    case std::filesystem::file_type::block:
    case std::filesystem::file_type::character:
      return "a device";
    case std::filesystem::file_type::fifo:
      return "a pipe";
    case std::filesystem::file_type::socket:
      return "a socket";
    default:
      return "no file";
  }
}

void require_replaceable(const Wish& wish) {
  const auto found = kind_of(wish.path);
  if (found == wish.kind) return;
  const bool is_plural = wish.kind == FileKind::maps || wish.kind == FileKind::edges;
  throw OutputRefusal(fmt::format("{} is {}, and --overwrite replaces {} by {} only", wish.path.string(),
                                  found ? words_of(*found) : "no file of rubatlas that can be read",
                                  words_of(wish.kind), is_plural ? words_of(wish.kind) : "another"));
}

/// Files appear by being renamed. Throws EnvironmentError.
void require_folder(const std::filesystem::path& given, const std::filesystem::path& place) {
  if (::access(directory_of(place).c_str(), W_OK | X_OK) == 0) return;
  throw EnvironmentError(fmt::format("cannot write {}: {}", given.string(), std::strerror(errno)));
}

}  // namespace

std::filesystem::path directory_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : ".";
}

const char* words_of(FileKind kind) {
  return entry(kind).words;
}

const char* word_of(FileKind kind) {
  return entry(kind).word;
}

std::optional<FileKind> kind_of(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) return std::nullopt;
  const std::string line = first_line(path);
  if (line.starts_with(kTableMark)) return FileKind::table;
  if (line.starts_with(kRecordMark)) return FileKind::record;
  return kind_of_hdf5(path);
}

std::string other_than(const std::filesystem::path& path, FileKind wanted) {
  if (const auto found = kind_of(path)) return *found == wanted ? "" : words_of(*found);
  const std::string line = first_line(path);
  const auto is_binary = [](char letter) {
    return static_cast<unsigned char>(letter) < 0x20 && letter != '\t' && letter != '\r';
  };
  const bool in_braces = line.starts_with('{') && std::ranges::none_of(line, is_binary);
  return in_braces ? "a text in braces, such as a scene" : "";
}

Output permitted(const Wish& wish, const std::vector<std::filesystem::path>& others) {
  const auto place = followed(wish.path);
  for (const auto& other : others) {
    if (is_same(place, other)) {
      throw OutputRefusal(fmt::format("{} and {} are the same file, and {} would replace it",
                                      wish.path.string(), other.string(), words_of(wish.kind)));
    }
  }
  std::error_code error;
  const auto status = std::filesystem::status(place, error);
  if (error == std::errc::filename_too_long)
    throw OutputRefusal(fmt::format("{}: its name is too long for the file system", wish.path.string()));
  if (!std::filesystem::exists(status)) {
    require_folder(wish.path, place);
    return {place, false};
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw OutputRefusal(
        fmt::format("{} is {}; the output must be a file", wish.path.string(), what_else(status.type())));
  }
  if (wish.if_there == Existing::refuse) {
    throw OutputRefusal(
        fmt::format("{} exists; {}--overwrite replaces it", wish.path.string(), wish.instead));
  }
  if (wish.if_there == Existing::keep) return {place, false};
  require_replaceable(wish);
  require_folder(wish.path, place);
  return {place, true};
}

}  // namespace rubatlas::atlas

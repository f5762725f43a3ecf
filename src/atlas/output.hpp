/// What a command may write, and what it may replace: the one rule for the outputs of all commands.
///
///  - Only regular files are written, links followed: never a directory, a device, a pipe.
///  - What a command reads, it does not write, by whatever path.
///  - What is there stays, unless `--overwrite` is given, and that replaces a file of the same kind only: an
///    atlas an atlas, a table a table. The kind is told by what the file itself says.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace rubatlas::atlas {

/// A call that cannot be carried out as given: one sentence, exit code 2.
class OutputRefusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class FileKind : std::uint8_t { atlas, maps, orbit, accuracy, table, record };

/// "an atlas", "maps", ...
const char* words_of(FileKind kind);
/// The word of the root attribute `kind`: "atlas", "maps", ...
const char* word_of(FileKind kind);
/// What a file is; nothing where it is none of ours, or not readable.
std::optional<FileKind> kind_of(const std::filesystem::path& path);

/// First lines of the text files, by which they are known.
constexpr const char* kTableMark = "<!-- rubatlas: regions and triggers -->";
constexpr const char* kRecordMark = "{\"runs\": [";

/// Where a file is to appear.
struct Output {
  // A path alone is a file that must not be there yet. NOLINTNEXTLINE(google-explicit-constructor)
  Output(std::filesystem::path where, bool replace = false) : path(std::move(where)), overwrite(replace) {}
  std::filesystem::path path;
  bool overwrite = false;  ///< may replace what stands there
};

/// What to do with a file that is there.
enum class Existing : std::uint8_t { refuse, replace, keep };
constexpr Existing existing(bool overwrite) {
  return overwrite ? Existing::replace : Existing::refuse;
}

/// What a command is to write.
struct Wish {
  std::filesystem::path path;
  FileKind kind = FileKind::atlas;
  Existing if_there = Existing::refuse;
};

/// The output where it may be written, links followed. `others`: what the command reads, and what else it
/// writes. Changes nothing on the disk. Throws OutputRefusal.
Output permitted(const Wish& wish, const std::vector<std::filesystem::path>& others);

}  // namespace rubatlas::atlas

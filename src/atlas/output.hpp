/// Which files a command may write and replace: one rule for the outputs of all commands.
///
///  - A command writes regular files only and follows links to them; it never writes to a directory, a device
///  or a pipe.
///  - A command never writes a file that it reads, by whatever path.
///  - An existing file is replaced only if `--overwrite` is given and the file is of the same kind: an atlas
///  by an atlas, a table by a table. The kind is read from the file itself.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace rubatlas::atlas {

/// A call that is refused because of its output: one sentence, exit code 2.
class OutputRefusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class FileKind : std::uint8_t { atlas, maps, edges, orbit, accuracy, branch, table, record };

/// "an atlas", "maps", ...
const char* words_of(FileKind kind);
/// The word of the root attribute `kind`: "atlas", "maps", ...
const char* word_of(FileKind kind);
/// The kind of a file; empty where the file is not of this program, or not readable.
std::optional<FileKind> kind_of(const std::filesystem::path& path);

/// What a sound file of another kind than `wanted` holds: "maps", "a text in braces, such as a scene". Empty
/// for the wanted kind, and for what is not known.
std::string other_than(const std::filesystem::path& path, FileKind wanted);

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

/// The folder that a file lies in.
std::filesystem::path directory_of(const std::filesystem::path& path);

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
  const char* instead = "";  ///< for the message of a refusal: what else the command can do with the file
};

/// The output with its links followed, if it may be written. `others` are the files that the command reads,
/// and its other outputs. Changes nothing on the disk. Throws OutputRefusal, and EnvironmentError where its
/// folder takes no files.
Output permitted(const Wish& wish, const std::vector<std::filesystem::path>& others);

}  // namespace rubatlas::atlas

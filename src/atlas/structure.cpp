#include "atlas/structure.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <span>
#include <string_view>

#include "atlas/environment_error.hpp"
#include "atlas/header_checksum.hpp"
#include "atlas/row_block.hpp"
#include "atlas/schema.hpp"
#include "atlas/software.hpp"
#include "point/line_solver.hpp"
#include "settings/reader.hpp"

namespace rubatlas::atlas {
namespace {

constexpr auto kDone = static_cast<std::uint8_t>(ending::PointStatus::done);
constexpr auto kLastStatus = static_cast<std::uint8_t>(ending::PointStatus::integrator_failed);

constexpr std::array<std::string_view, 5> kReadVersions{
    kSchemaVersion, kVersionOfWholeLines, kVersionWithoutSettled, kVersionOfHybrid, kVersionWithoutChecksums};

const char* words_of(NumberType type) {
  switch (type) {
    case NumberType::uint8:
      return "8-bit unsigned";
    case NumberType::uint16:
      return "16-bit unsigned";
    case NumberType::int32:
      return "32-bit signed";
    case NumberType::uint32:
      return "32-bit unsigned";
    case NumberType::float64:
      break;
  }
  return "64-bit floating-point";
}

bool holds(const Dataset& dataset, NumberType type) {
  switch (type) {
    case NumberType::uint8:
      return dataset.holds<std::uint8_t>();
    case NumberType::uint16:
      return dataset.holds<std::uint16_t>();
    case NumberType::int32:
      return dataset.holds<std::int32_t>();
    case NumberType::uint32:
      return dataset.holds<std::uint32_t>();
    case NumberType::float64:
      break;
  }
  return dataset.holds<double>();
}

/// One file under examination.
class Examination {
 public:
  Examination(const File& file, const std::string& path) : file_(file), path_(path) {}

  void require_kind() const {
    const Object root = file_.root();
    if (!root.has_attribute("schema_version") || !file_.has_dataset("/status") ||
        !file_.has_dataset("/scene_resolved")) {
      throw EnvironmentError(fmt::format("{} is not an atlas of rubatlas", path_));
    }
    const std::string version = root.text("schema_version");
    if (std::ranges::count(kReadVersions, version) == 0) {
      throw EnvironmentError(fmt::format("{} has the layout of version {}; this program reads version {}",
                                         path_, version, kSchemaVersion));
    }
    for (const char* name : {"software", "software_version", "git_commit", "compiler", "title"}) {
      if (!root.has_attribute(name)) refuse(fmt::format("its root has no text {}", name));
      static_cast<void>(root.text(name));
    }
  }

  [[nodiscard]] settings::Scene scene() const {
    for (const char* name : {"/scene", "/scene_resolved"}) {
      if (!dataset(name).holds_texts()) refuse(fmt::format("{} is not a text", name));
    }
    try {
      return settings::parse_scene(resolved_scene(file_), "/scene_resolved");
    } catch (const settings::SceneError& error) {
      refuse(fmt::format("/scene_resolved is not a scene of this version: {}", error.what()));
    }
  }

  void require_axis(const plan::Axis& axis) const {
    const Dataset scale = dataset("/" + axis.name);
    require_numbers(scale, axis.name, NumberType::float64, {axis.values.size()});
    require_scale(scale, axis.name);
    if (scale.read<double>() != axis.values)
      refuse(fmt::format("/{} has not the values of its scene", axis.name));
    static_cast<void>(scale.text("units"));
    static_cast<void>(scale.text("long_name"));
  }

  void require_inner_axis(const observables::InnerAxis& axis) const {
    const Dataset scale = dataset("/" + axis.name);
    if (scale.shape() != Shape{axis.size()})
      refuse(fmt::format("/{} has not the length that its scene asks for", axis.name));
    require_scale(scale, axis.name);
    const auto same = std::visit(
        [&](const auto& values) {
          using Value = typename std::decay_t<decltype(values)>::value_type;
          if constexpr (std::is_same_v<Value, std::string>) {
            return scale.holds_texts() && file_.read_texts("/" + axis.name) == values;
          } else {
            return scale.holds<Value>() && scale.template read<Value>() == values;
          }
        },
        axis.values);
    if (!same) refuse(fmt::format("/{} has not the values of its scene", axis.name));
  }

  void require_rows(const Schema& schema, const RowDataset& rows) const {
    const Dataset found = dataset("/" + rows.name);
    require_numbers(found, rows.name, rows.type, rows.shape);
    std::vector<std::string> wanted;
    for (const auto& axis : schema.axes) wanted.push_back(axis.name);
    wanted.insert(wanted.end(), rows.inner_axes.begin(), rows.inner_axes.end());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (const std::string scale = found.scale_name(i); scale != wanted[i]) {
        refuse(fmt::format("axis {} of /{} {}, and should run along /{}", i, rows.name,
                           scale.empty() ? "has no scale" : "runs along /" + scale, wanted[i]));
      }
    }
  }

  void require_readable_points(const Schema& schema) const {
    const auto status = file_.dataset("/status").read<std::uint8_t>();
    const auto unknown = std::ranges::find_if(status, [](auto code) { return code > kLastStatus; });
    if (unknown != status.end()) {
      refuse(fmt::format("/status of point {} is {}, and no status is above {}", unknown - status.begin(),
                         *unknown, kLastStatus));
    }
    const Shape grid = file_.dataset("/status").shape();
    require_finite(schema.final_state, grid, status);
    for (const auto& memory : schema.memories) require_finite(memory, grid, status);
  }

  [[nodiscard]] plan::Part require_part(const std::vector<plan::Axis>& axes) const {
    if (!file_.root().has_attribute("part")) return {};
    const std::string text = file_.root().text("part");
    std::size_t lines = 1;
    for (std::size_t i = 0; i + 1 < axes.size(); ++i) lines *= axes[i].values.size();
    const auto part = plan::read_part(text);
    if (!part || part->count > lines) refuse(fmt::format("its part {} is none of {} lines", text, lines));
    return *part;
  }

  [[nodiscard]] bool has(const std::string& name) const { return file_.has(name); }

 private:
  [[noreturn]] void refuse(const std::string& fact) const {
    throw EnvironmentError(
        fmt::format("{}: {}; the file is damaged, or not an atlas of this program", path_, fact));
  }

  [[nodiscard]] Dataset dataset(const std::string& name) const {
    if (!file_.has(name)) refuse(fmt::format("{} is missing", name));
    if (!file_.has_dataset(name)) refuse(fmt::format("{} is no dataset of this file", name));
    Dataset found = file_.dataset(name);
    if (found.is_elsewhere()) refuse(fmt::format("{} keeps its numbers in another file", name));
    return found;
  }

  void require_numbers(const Dataset& dataset, const std::string& name, NumberType type,
                       const Shape& shape) const {
    if (!holds(dataset, type)) refuse(fmt::format("/{} does not hold {} numbers", name, words_of(type)));
    if (const Shape found = dataset.shape(); found != shape) {
      refuse(fmt::format("/{} has the shape ({}), and its scene asks for ({})", name, fmt::join(found, ", "),
                         fmt::join(shape, ", ")));
    }
  }

  void require_scale(const Dataset& dataset, const std::string& name) const {
    if (!dataset.is_scale()) refuse(fmt::format("/{} is no dimension scale", name));
  }

  /// Reads so many rows at once.
  static constexpr std::size_t kPointsAtOnce = 1 << 16;

  void require_finite(const RowDataset& rows, const Shape& grid, std::span<const std::uint8_t> status) const {
    const Dataset dataset = file_.dataset("/" + rows.name);
    for (std::size_t first = 0; first < status.size();) {
      const PointBlock block = block_at(grid, first, status.size(), kPointsAtOnce);
      const auto codes = status.subspan(first, block.count);
      first += block.count;
      if (std::ranges::find(codes, kDone) == codes.end()) continue;
      const auto [start, count] = place_in(dataset, block);
      const auto values = dataset.read_block<double>(start, count);
      const std::size_t size = values.size() / codes.size();
      for (std::size_t i = 0; i < codes.size(); ++i) {
        const auto row = std::span(values).subspan(i * size, size);
        if (codes[i] != kDone || std::ranges::all_of(row, [](double x) { return std::isfinite(x); }))
          continue;
        refuse(fmt::format("/{} of point {}, which is done, is not finite", rows.name, block.first + i));
      }
    }
  }

  const File& file_;
  const std::string& path_;
};

/// Limit of processor time [s], since HDF5 may loop for ever in a damaged file. An examination of 1e8 points
/// takes less.
constexpr rlim_t kMostTime = 10;

/// Limit of memory beyond what the process has and twice the file's size [B]: a length that is damaged lets
/// HDF5 ask for any number of bytes.
constexpr rlim_t kMostMemory = 1'000'000'000;

/// Keeps this process, which is to read a file that may be damaged, from taking the machine.
void limit_resources(const std::filesystem::path& path) {
  const rlimit time{kMostTime, kMostTime};
  ::setrlimit(RLIMIT_CPU, &time);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  std::ifstream usage("/proc/self/statm");
  std::array<rlim_t, 6> pages{};  // the last: private memory
  for (rlim_t& count : pages) usage >> count;
  std::error_code failed;
  const rlim_t size = std::filesystem::file_size(path, failed);
  if (!usage || failed) return;
  const rlim_t most = pages.back() * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + 2 * size + kMostMemory;
  const rlimit memory{most, most};
  ::setrlimit(RLIMIT_DATA, &memory);
}

/// Exit code of the separate process for a file of another kind.
constexpr int kWrongFile = 2;

void require_no_other_kind(const std::filesystem::path& path) {
  const std::string other = other_than(path, FileKind::atlas);
  if (!other.empty())
    throw WrongFile(
        fmt::format("{} holds {}; an atlas is wanted here, which rubatlas run makes", path.string(), other));
}

/// Examines a file in a separate process, and throws the exception that this finds.
void examine_apart(const std::filesystem::path& path) {
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) return;
  const pid_t child = ::fork();
  if (child == 0) {
    limit_resources(path);
    // The message of the C library about a crash would not help the user.
    if (const int nowhere = ::open("/dev/null", O_WRONLY); nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
    int code = EXIT_SUCCESS;
    const auto tell = [&](std::string_view sentence) {
      static_cast<void>(::write(pipe[1], sentence.data(), sentence.size()) < 0);
    };
    try {
      require_no_other_kind(path);
      const File file = File::open_to_read(path);
      static_cast<void>(require_atlas(file, path.string()));
    } catch (const WrongFile& wrong) {
      tell(wrong.what());
      code = kWrongFile;
    } catch (const EnvironmentError& error) {
      tell(error.what());
    } catch (...) {
      code = EXIT_FAILURE;
    }
    ::_exit(code);
  }
  ::close(pipe[1]);
  std::string sentence;
  std::array<char, 4096> buffer{};
  for (ssize_t length = 0; (length = ::read(pipe[0], buffer.data(), buffer.size())) != 0;) {
    if (length > 0) sentence.append(buffer.data(), static_cast<std::size_t>(length));
    if (length < 0 && errno != EINTR) break;
  }
  ::close(pipe[0]);
  int status = 0;
  while (child > 0 && ::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!sentence.empty() && WIFEXITED(status) && WEXITSTATUS(status) == kWrongFile) throw WrongFile(sentence);
  if (!sentence.empty()) throw EnvironmentError(sentence);
  if (status != 0) throw EnvironmentError(fmt::format("{} is damaged: it cannot be read", path.string()));
}

}  // namespace

plan::Part require_part(const File& file, const std::string& path, const std::vector<plan::Axis>& axes) {
  return Examination(file, path).require_part(axes);
}

File open_with_care(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored) && header_of(path) != Header::sound)
    examine_apart(path);
  return File::open_to_read(path);
}

std::string resolved_scene(const File& file) {
  std::string text = file.read_text("/scene_resolved");
  const std::string version = file.root().text("schema_version");
  if (version == kSchemaVersion) return text;
  return settings::of_older_program(text, version == kVersionOfWholeLines);
}

bool lacks_checksums(const File& file) {
  return file.root().text("schema_version") == kVersionWithoutChecksums;
}

std::vector<plan::Axis> require_atlas(const File& file, const std::string& path) {
  const Examination examination(file, path);
  examination.require_kind();
  const Schema schema = schema_of(examination.scene());
  for (const auto& axis : schema.axes) examination.require_axis(axis);
  for (const auto& axis : observables::inner_axes(examination.scene())) examination.require_inner_axis(axis);
  const bool old = lacks_checksums(file);
  for (const auto* rows : schema.row_datasets()) {
    if (old && !examination.has(rows->name)) continue;  // added in version 2
    examination.require_rows(schema, *rows);
  }
  examination.require_readable_points(schema);
  return schema.axes;
}

}  // namespace rubatlas::atlas

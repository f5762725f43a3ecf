#include "mpi/commands/merge_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "atlas/atlas_reader.hpp"
#include "atlas/copy.hpp"
#include "atlas/free_space.hpp"
#include "atlas/schema.hpp"
#include "mpi/commands/status_command.hpp"
#include "mpi/commands/unless_stopped.hpp"
#include "mpi/exit_code.hpp"
#include "mpi/job/run_record.hpp"
#include "mpi/say.hpp"
#include "settings/reader.hpp"

namespace rubatlas::mpi {
namespace {

/// "part 2/8", or "a whole atlas".
std::string words_of(const plan::Part& part) {
  return part.is_whole() ? "a whole atlas" : "part " + plan::text_of(part);
}

/// Ascending by their numbers, so that the order of the arguments does not matter.
std::vector<atlas::AtlasReader> read_parts(const std::vector<std::filesystem::path>& paths) {
  std::vector<atlas::AtlasReader> parts;
  for (const auto& path : paths) {
    parts.emplace_back(path);
    atlas::require_sound_header(parts.back());
  }
  std::ranges::stable_sort(parts, {}, [](const auto& part) { return part.part().number; });
  return parts;
}

/// Parts of one atlas have the same scene, which was divided into the same number of parts.
void require_parts_of_one_atlas(const atlas::AtlasReader& one, const atlas::AtlasReader& other) {
  const std::string name = other.path().string();
  const std::string difference = settings::difference(other.scene_resolved(), one.scene_resolved());
  if (!difference.empty()) {
    throw UsageError(
        fmt::format("{} was made from another scene than {}: {}", name, one.path().string(), difference));
  }
  if (one.part().count != other.part().count) {
    throw UsageError(fmt::format("{} is {} and {} is {}: these are not parts of one division",
                                 one.path().string(), words_of(one.part()), name, words_of(other.part())));
  }
}

void require_other_lines(const atlas::AtlasReader& one, const atlas::AtlasReader& next) {
  if (one.part() != next.part()) return;
  throw UsageError(fmt::format("{} and {} have the same lines: each is {}", one.path().string(),
                               next.path().string(), words_of(one.part())));
}

void say_of_builds(const atlas::AtlasReader& one, const atlas::AtlasReader& other) {
  const auto a = atlas::software_of(one.file());
  const auto b = atlas::software_of(other.file());
  if (a == b) return;
  say_sentence(fmt::format(
      "{} was begun by commit {} ({}), {} by {} ({}): points may differ in the last digits from those of one "
      "run",
      one.path().string(), a.git_commit, a.compiler, other.path().string(), b.git_commit, b.compiler));
}

void say_what_is_missing(const std::vector<atlas::AtlasReader>& parts) {
  std::vector<std::string> missing;
  for (std::size_t number = 1, i = 0; number <= parts.front().part().count; ++number) {
    if (i < parts.size() && parts[i].part().number == number) {
      ++i;
    } else {
      missing.push_back(plan::text_of({number, parts.front().part().count}));
    }
  }
  if (!missing.empty()) {
    say_sentence(fmt::format("missing: part{} {}", missing.size() > 1 ? "s" : "", fmt::join(missing, ", ")));
  }
  for (const auto& part : parts) {
    const Standing standing = standing_of_atlas(part);
    if (standing.finished < standing.total) say_sentence("incomplete: " + status_sentence(part, standing));
  }
}

}  // namespace

int merge(const MergeCommand& command) {
  const auto output = atlas::permitted(
      {command.output, atlas::FileKind::atlas, atlas::existing(command.overwrite)}, command.parts);
  const std::vector<atlas::AtlasReader> parts = read_parts(command.parts);
  const atlas::AtlasReader& first = parts.front();
  std::vector<atlas::RowSource> sources;
  std::vector<std::filesystem::path> paths;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    require_parts_of_one_atlas(first, parts[i]);
    if (i > 0) require_other_lines(parts[i - 1], parts[i]);
    sources.push_back({parts[i], parts[i].points_of_part()});
    paths.push_back(parts[i].path());
  }
  const auto record = record_output(output.path, paths);
  const settings::Scene scene = settings::parse_scene(first.scene_resolved(), "/scene_resolved");
  atlas::require_space(output.path, atlas::schema_of(scene).byte_count());
  for (std::size_t i = 1; i < parts.size(); ++i) say_of_builds(first, parts[i]);
  const atlas::AtlasHeader header{scene, first.scene(), atlas::software_of(first.file())};
  if (!copy_unless_stopped(output, header, atlas::RowStorage::fixed, sources)) return exit_code::kInterrupted;
  merge_records(record, paths);

  say_what_is_missing(parts);
  const atlas::AtlasReader whole(output.path);
  const Standing standing = standing_of_atlas(whole);
  print(status_sentence(whole, standing) + "\n");
  return exit_code_of(standing);
}

}  // namespace rubatlas::mpi

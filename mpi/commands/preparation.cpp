#include "mpi/commands/preparation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "atlas/atlas_reader.hpp"
#include "atlas/create.hpp"
#include "atlas/environment_error.hpp"
#include "atlas/free_space.hpp"
#include "atlas/header_checksum.hpp"
#include "atlas/output.hpp"
#include "atlas/schema.hpp"
#include "atlas/verify.hpp"
#include "mpi/commands/explain.hpp"
#include "mpi/commands/memory_need.hpp"
#include "mpi/commands/notes.hpp"
#include "mpi/exit_code.hpp"
#include "mpi/job/point_runner.hpp"
#include "mpi/job/run_record.hpp"
#include "mpi/say.hpp"
#include "plan/grid.hpp"
#include "settings/reader.hpp"

namespace rubatlas::mpi {
namespace {

/// A run may resume only an atlas of an equal scene.
void require_same_scene(const RunOptions& options, const atlas::AtlasReader& existing,
                        const settings::Scene& scene) {
  const std::string difference =
      settings::difference(existing.scene_resolved(), settings::resolved_json(scene));
  if (!difference.empty()) {
    throw UsageError(fmt::format("{} was made from another scene: {}", options.atlas.string(), difference));
  }
}

/// A run may not resume an atlas that has changed since it was written.
void require_sound_header(const atlas::AtlasReader& existing) {
  if (!existing.has_checksums()) {
    throw atlas::EnvironmentError(fmt::format(
        "{} was begun by a version whose rows have no checksums, and no run goes on with it; it can "
        "be read, or begun anew with --overwrite",
        existing.path().string()));
  }
  if (const std::string damage = atlas::header_damage(existing.path()); !damage.empty()) {
    throw atlas::EnvironmentError(damage);
  }
}

bool goes_on(const RunOptions& options) {
  return options.resume && std::filesystem::exists(options.atlas);
}

/// Makes all refusals that need no change on the disk. Returns the path of the atlas.
atlas::Output require_possible(const RunOptions& options, const settings::Scene& scene) {
  if (options.resume && options.overwrite) {
    throw UsageError("--resume completes an atlas and --overwrite replaces it: one of the two");
  }
  auto output =
      atlas::permitted({options.atlas, atlas::FileKind::atlas,
                        options.resume ? atlas::Existing::keep : atlas::existing(options.overwrite)},
                       {options.scene});
  static_cast<void>(record_output(output.path, options.scene));
  if (goes_on(options)) {
    const atlas::AtlasReader existing(output.path);
    require_sound_header(existing);
    require_same_scene(options, existing, scene);
    atlas::require_sound_rows(existing);
  }
  const atlas::Schema schema = atlas::schema_of(scene);
  atlas::require_space(output.path, schema.byte_count(),
                       fmt::format("{} points × {} a row", plan::Grid(scene).point_count(),
                                   atlas::readable_bytes(schema.bytes_per_point())));
  const MemoryNeed need = memory_need(scene, PointRunner::kSolversKept);
  if (const std::uint64_t memory = memory_of_process(); need.together() > static_cast<double>(memory)) {
    throw atlas::EnvironmentError(
        fmt::format("the scene is too large for the memory of {} that this process may have: {}",
                    atlas::readable_bytes(memory), memory_text(need)));
  }
  return output;
}

}  // namespace

Preparation prepare(const RunOptions& options, const atlas::Software& software) {
  Preparation preparation;
  preparation.scene_text = settings::read_text(options.scene);
  const settings::Scene scene = settings::parse_scene(preparation.scene_text, options.scene.string());
  const atlas::Output output = require_possible(options, scene);
  preparation.atlas = output.path;
  for (const auto& doubt : doubts_about(scene)) say_sentence("note: " + doubt);

  // An existing atlas is locked before it is resumed or replaced, a new one before it gets its name, so that
  // no other run can take it at any moment.
  std::optional<atlas::AtlasLock>& lock = preparation.lock;
  if (std::filesystem::exists(output.path)) lock.emplace(output.path);
  if (!goes_on(options)) {
    atlas::create_atlas(output, scene, preparation.scene_text, software, [&](const auto& unpublished) {
      if (lock) {
        lock->move_to(unpublished);
      } else {
        lock.emplace(unpublished, output.path);
      }
    });
  }
  if (const std::string remark = lock->remark(); !remark.empty()) {
    say_sentence(remark);
  }
  const atlas::AtlasReader atlas(output.path);
  if (const std::string commit = atlas.file().root().text("git_commit"); commit != software.git_commit) {
    say_sentence(
        fmt::format("{} was begun by commit {}, this is {}: its points may differ in the last digits",
                    options.atlas.string(), commit, software.git_commit));
  }
  preparation.status = atlas.status();
  preparation.ends = atlas::FinalStates(atlas, scene);
  return preparation;
}

std::string rehearse(const RunOptions& options) {
  const settings::Scene scene =
      settings::parse_scene(settings::read_text(options.scene), options.scene.string());
  static_cast<void>(require_possible(options, scene));
  std::size_t pending = plan::Grid(scene).point_count();
  if (goes_on(options)) {
    const auto status = atlas::AtlasReader(options.atlas).status();
    pending = static_cast<std::size_t>(std::count(status.begin(), status.end(), 0));
  }
  return fmt::format("{}\nDry run: {} points would be computed into {}; nothing has been written.\n",
                     explain(scene), pending, options.atlas.string());
}

}  // namespace rubatlas::mpi

#include "mpi/preparation.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "atlas/atlas_reader.hpp"
#include "atlas/create.hpp"
#include "atlas/free_space.hpp"
#include "atlas/schema.hpp"
#include "mpi/exit_code.hpp"
#include "scene/reader.hpp"

namespace rubatlas::mpi {
namespace {

/// Nothing that exists is overwritten, or added to, unasked.
void require_permission(const RunOptions& options) {
  if (std::filesystem::exists(options.atlas) && !options.resume && !options.overwrite) {
    throw UsageError(
        fmt::format("{} exists; --resume completes it, --overwrite replaces it", options.atlas.string()));
  }
}

/// A run may go on with what an equal scene has begun, and with nothing else.
void require_same_scene(const RunOptions& options, const scene::Scene& scene,
                        const atlas::Software& software) {
  const atlas::AtlasReader existing(options.atlas);
  const std::string difference = scene::difference(existing.scene_resolved(), scene::resolved_json(scene));
  if (!difference.empty()) {
    throw UsageError(fmt::format("{} was made from another scene: {}", options.atlas.string(), difference));
  }
  const std::string commit = existing.file().root().text("git_commit");
  if (commit != software.git_commit) {
    fmt::print(
        stderr,
        "rubatlas: {} was begun by commit {}, this is {}: its points may differ in their last digits\n",
        options.atlas.string(), commit, software.git_commit);
  }
}

}  // namespace

Preparation prepare(const RunOptions& options, const atlas::Software& software) {
  if (options.resume && options.overwrite) {
    throw UsageError("--resume completes an atlas and --overwrite replaces it: one of the two");
  }
  Preparation preparation;
  preparation.scene_text = scene::read_text(options.scene);
  const scene::Scene scene = scene::parse_scene(preparation.scene_text, options.scene.string());

  atlas::require_space(options.atlas, atlas::schema_of(scene).byte_count());
  require_permission(options);
  preparation.run_lock.emplace(atlas::FileLock::beside(options.atlas));
  require_permission(options);  // again: another run may have made the file before the lock was ours
  if (options.resume && std::filesystem::exists(options.atlas)) {
    require_same_scene(options, scene, software);
  } else {
    atlas::create_atlas(options.atlas, scene, preparation.scene_text, software);
  }
  preparation.atlas_lock.emplace(atlas::FileLock::shared_on(options.atlas));
  const atlas::AtlasReader atlas(options.atlas);
  preparation.status = atlas.status();
  preparation.final_states = atlas.rows("/final_state");
  return preparation;
}

}  // namespace rubatlas::mpi

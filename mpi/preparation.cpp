#include "mpi/preparation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "atlas/atlas_reader.hpp"
#include "atlas/create.hpp"
#include "atlas/free_space.hpp"
#include "atlas/schema.hpp"
#include "mpi/exit_code.hpp"
#include "mpi/explain.hpp"
#include "plan/grid.hpp"
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
void require_same_scene(const RunOptions& options, const scene::Scene& scene) {
  const atlas::AtlasReader existing(options.atlas);
  const std::string difference = scene::difference(existing.scene_resolved(), scene::resolved_json(scene));
  if (!difference.empty()) {
    throw UsageError(fmt::format("{} was made from another scene: {}", options.atlas.string(), difference));
  }
}

/// All that can be refused without touching the disk.
void require_possible(const RunOptions& options, const scene::Scene& scene) {
  if (options.resume && options.overwrite) {
    throw UsageError("--resume completes an atlas and --overwrite replaces it: one of the two");
  }
  require_permission(options);
  if (options.resume && std::filesystem::exists(options.atlas)) require_same_scene(options, scene);
  atlas::require_space(options.atlas, atlas::schema_of(scene).byte_count());
}

}  // namespace

Preparation prepare(const RunOptions& options, const atlas::Software& software) {
  Preparation preparation;
  preparation.scene_text = scene::read_text(options.scene);
  const scene::Scene scene = scene::parse_scene(preparation.scene_text, options.scene.string());
  require_possible(options, scene);

  preparation.run_lock.emplace(atlas::FileLock::beside(options.atlas));
  require_permission(options);  // again: another run may have made the file before the lock was ours
  if (options.resume && std::filesystem::exists(options.atlas)) {
    require_same_scene(options, scene);
  } else {
    atlas::create_atlas(options.atlas, scene, preparation.scene_text, software);
  }
  preparation.atlas_lock.emplace(atlas::FileLock::shared_on(options.atlas));
  const atlas::AtlasReader atlas(options.atlas);
  if (const std::string commit = atlas.file().root().text("git_commit"); commit != software.git_commit) {
    fmt::print(stderr,
               "rubatlas: {} was begun by commit {}, this is {}: its points may differ in the last digits\n",
               options.atlas.string(), commit, software.git_commit);
  }
  preparation.status = atlas.status();
  preparation.ends = atlas::FinalStates(atlas, scene);
  return preparation;
}

std::string rehearse(const RunOptions& options) {
  const scene::Scene scene = scene::parse_scene(scene::read_text(options.scene), options.scene.string());
  require_possible(options, scene);
  std::size_t pending = plan::Grid(scene).point_count();
  if (options.resume && std::filesystem::exists(options.atlas)) {
    const auto status = atlas::AtlasReader(options.atlas).status();
    pending = static_cast<std::size_t>(std::count(status.begin(), status.end(), 0));
  }
  return fmt::format("{}\nDry run: {} points would be computed into {}; nothing has been written.\n",
                     explain(scene), pending, options.atlas.string());
}

}  // namespace rubatlas::mpi

#include "mpi/commands/preparation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "atlas/atlas_reader.hpp"
#include "atlas/copy.hpp"
#include "atlas/create.hpp"
#include "atlas/environment_error.hpp"
#include "atlas/free_space.hpp"
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
#include "settings/scene_file.hpp"

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

/// A run may resume a part only as this part, and a packed atlas not at all.
void require_same_part(const RunOptions& options, const atlas::AtlasReader& existing) {
  const plan::Part& part = existing.part();
  if (options.part && *options.part != part) {
    throw UsageError(fmt::format("{} is {}, and --part asks for part {}", options.atlas.string(),
                                 part.is_whole() ? "a whole atlas" : "part " + plan::text_of(part),
                                 plan::text_of(*options.part)));
  }
  if (existing.is_packed()) {
    throw UsageError(
        fmt::format("{} is packed and takes no more rows; --resume goes on with the atlas that it "
                    "is a copy of",
                    options.atlas.string()));
  }
}

/// A part has one line at least.
void require_lines(const plan::Part& part, const plan::Grid& grid) {
  if (part.count <= grid.line_count()) return;
  throw UsageError(fmt::format("--part {}: the scene has {} line{}, and a part has one at least",
                               plan::text_of(part), grid.line_count(), grid.line_count() == 1 ? "" : "s"));
}

bool goes_on(const RunOptions& options) {
  return options.resume && std::filesystem::exists(options.atlas);
}

struct Permission {
  atlas::Output output;
  plan::Part part;  ///< of the grid, that the run computes
};

/// Makes all refusals that need no change on the disk.
Permission require_possible(const RunOptions& options, const settings::Scene& scene) {
  if (options.resume && options.overwrite) {
    throw UsageError("--resume completes an atlas and --overwrite replaces it: one of the two");
  }
  auto output = atlas::permitted({options.atlas, atlas::FileKind::atlas,
                                  options.resume ? atlas::Existing::keep : atlas::existing(options.overwrite),
                                  "--resume completes it, "},
                                 {options.scene});
  static_cast<void>(record_output(output.path, {options.scene}));
  const plan::Grid grid(scene);
  plan::Part part = options.part.value_or(plan::Part{});
  require_lines(part, grid);
  if (goes_on(options)) {
    const atlas::AtlasReader existing(output.path);
    atlas::require_sound_header(existing);
    require_same_scene(options, existing, scene);
    require_same_part(options, existing);
    atlas::require_sound_rows(existing);
    part = existing.part();
  }
  const atlas::Schema schema = atlas::schema_of(scene);
  const std::size_t points = plan::points_of(part, grid).count();
  const std::uint64_t row_bytes = schema.bytes_per_point();
  atlas::require_space(output.path, part.is_whole() ? schema.byte_count() : points * row_bytes,
                       fmt::format("{} points × {} a row", points, atlas::readable_bytes(row_bytes)),
                       schema.byte_count());
  const MemoryNeed need = memory_need(scene, PointRunner::kSolversKept);
  if (const std::uint64_t memory = memory_of_process(); need.together() > static_cast<double>(memory)) {
    throw atlas::EnvironmentError(
        fmt::format("the scene is too large for the memory of {} that this process may have: {}",
                    atlas::readable_bytes(memory), memory_text(need)));
  }
  return {std::move(output), part};
}

}  // namespace

Preparation prepare(const RunOptions& options, const atlas::Software& software) {
  Preparation preparation;
  preparation.scene_text = settings::read_text(options.scene);
  const settings::Scene scene = settings::parse_scene(preparation.scene_text, options.scene.string());
  const Permission permission = require_possible(options, scene);
  const atlas::Output& output = permission.output;
  preparation.atlas = output.path;
  preparation.part = permission.part;
  for (const auto& doubt : doubts_about(scene)) say_sentence("note: " + doubt);

  // An existing atlas is locked before it is resumed or replaced, a new one before it gets its name, so that
  // no other run can take it at any moment.
  std::optional<atlas::AtlasLock>& lock = preparation.lock;
  if (std::filesystem::exists(output.path)) lock.emplace(output.path);
  const bool is_new = !goes_on(options);
  const plan::Grid grid(scene);
  if (is_new) {
    const atlas::AtlasHeader header{scene, preparation.scene_text, software, permission.part};
    atlas::create_atlas(output, header, [&](const auto& unpublished) {
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
  if (is_new) {
    preparation.status.assign(grid.point_count(), 0);
    if (scene.pieces) preparation.seam = preparation.status;
  } else {
    const atlas::AtlasReader atlas(output.path);
    if (const std::string commit = atlas.file().root().text("git_commit"); commit != software.git_commit) {
      say_sentence(
          fmt::format("{} was begun by commit {}, this is {}: its points may differ in the last digits",
                      options.atlas.string(), commit, software.git_commit));
    }
    preparation.status = atlas.status();
    if (scene.pieces) preparation.seam = atlas.seam();
  }
  const auto [first, end] = plan::points_of(permission.part, grid);
  std::fill_n(preparation.status.begin(), first, kOfAnotherPart);
  std::fill(preparation.status.begin() + static_cast<std::ptrdiff_t>(end), preparation.status.end(),
            kOfAnotherPart);
  return preparation;
}

std::string rehearse(const RunOptions& options) {
  const settings::Scene scene =
      settings::parse_scene(settings::read_text(options.scene), options.scene.string());
  const plan::Part part = require_possible(options, scene).part;
  const plan::Grid grid(scene);
  const auto [first, end] = plan::points_of(part, grid);
  std::size_t pending = end - first;
  if (goes_on(options)) {
    const auto status = atlas::AtlasReader(options.atlas).status();
    pending = static_cast<std::size_t>(std::ranges::count(std::span(status).subspan(first, end - first), 0));
  }
  const std::string lines = part.is_whole() ? ""
                                            : fmt::format(" (part {} of the scene: lines {} to {} of {})",
                                                          plan::text_of(part), first / grid.speed_count() + 1,
                                                          end / grid.speed_count(), grid.line_count());
  return fmt::format("{}\nDry run: {} points would be computed into {}{}; nothing has been written.\n",
                     explain(scene), pending, options.atlas.string(), lines);
}

}  // namespace rubatlas::mpi

/// What rank 0 does before a job's first point: reads the scene, decides whether the atlas may be written,
/// and has it ready on the disk. The other ranks wait for its verdict.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "atlas/final_states.hpp"
#include "atlas/lock.hpp"
#include "atlas/software.hpp"
#include "mpi/commands/run.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

struct Preparation {
  std::string scene_text;
  std::vector<std::uint8_t> status;      ///< per point, as the atlas has it
  atlas::FinalStates ends;               ///< of all points, where status is done
  std::filesystem::path atlas;           ///< where it is, links followed
  std::optional<atlas::AtlasLock> lock;  ///< no second run, no other writer
};

/// Throws settings::SceneError, UsageError, atlas::OutputRefusal or atlas::EnvironmentError; then nothing has
/// been changed on the disk.
Preparation prepare(const RunOptions& options, const atlas::Software& software);

/// What `--dry-run` prints. All that `prepare` would refuse is refused, and nothing is written.
std::string rehearse(const RunOptions& options);

}  // namespace rubatlas::mpi

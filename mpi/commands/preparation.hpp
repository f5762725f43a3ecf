/// What rank 0 does before a job's first point: reads the scene, decides whether the atlas may be written,
/// and has it ready on the disk. The other ranks wait for its verdict.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "atlas/lock.hpp"
#include "atlas/software.hpp"
#include "mpi/commands/run.hpp"
#include "plan/part.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

/// No status of a point: the point belongs to another part of the grid, and no rank computes it.
constexpr std::uint8_t kOfAnotherPart = 255;

struct Preparation {
  std::string scene_text;
  std::vector<std::uint8_t> status;      ///< per point, as the atlas has it, or kOfAnotherPart
  std::vector<std::uint8_t> seam;        ///< per point where lines are swept in pieces, else empty
  plan::Part part;                       ///< of the grid, which the atlas is for
  std::filesystem::path atlas;           ///< its path, links followed
  std::optional<atlas::AtlasLock> lock;  ///< refuses a second run and other writers
};

/// Throws settings::SceneError, UsageError, atlas::OutputRefusal or atlas::EnvironmentError, and has then
/// changed nothing on the disk.
Preparation prepare(const RunOptions& options, const atlas::Software& software);

/// The text of `--dry-run`. Refuses whatever `prepare` would refuse, and writes nothing.
std::string rehearse(const RunOptions& options);

}  // namespace rubatlas::mpi

/// The main job: a scene to an atlas, under mpirun or alone.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "atlas/atlas_writer.hpp"
#include "mpi/job/progress.hpp"
#include "plan/part.hpp"

namespace rubatlas::mpi {

struct RunOptions {
  std::filesystem::path scene;
  std::filesystem::path atlas;
  std::optional<plan::Part> part;  ///< of the scene's grid; none: the whole grid, or the part that an atlas
                                   ///< to be resumed is for
  bool resume = false;
  bool overwrite = false;
  bool dry_run = false;
  int batch_milliseconds =
      atlas::AtlasWriter::kBatchPeriod.count();  ///< time between rows and their statuses
  ProgressStyle progress = ProgressStyle::automatic;
  std::vector<std::string> words;  ///< the command line as it was given, the program's name first
};

/// Runs the job on all ranks and returns the exit code of this rank (`exit_code.hpp`). Initialises MPI only
/// when started by mpirun.
int run(const RunOptions& options);

}  // namespace rubatlas::mpi

/// `<atlas>.run.json`: whatever differs from run to run and therefore must not be in the atlas.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "atlas/output.hpp"
#include "atlas/software.hpp"
#include "mpi/master.hpp"

namespace rubatlas::mpi {

struct RunRecord {
  std::chrono::system_clock::time_point started;
  std::vector<std::string> hosts;     ///< one per rank
  std::vector<std::string> lanes;     ///< one per rank: lines that it can follow side by side
  std::vector<std::string> in_lanes;  ///< one per rank: attempts of steps made beside others
  bool resumed = false;
  int exit_code = 0;
  JobResult result;
};

/// Where the record of an atlas is: never over the scene, and over nothing but a record. Throws
/// atlas::OutputRefusal.
atlas::Output record_output(const std::filesystem::path& atlas, const std::filesystem::path& scene);

/// Adds a run to the record beside an atlas; `resumed` runs join those before them, others start it anew.
/// Throws EnvironmentError.
void write_run_record(const atlas::Output& output, const RunRecord& record, const atlas::Software& software);

/// A text between quotation marks, as JSON wants it.
std::string json_text(const std::string& text);

}  // namespace rubatlas::mpi

/// `<atlas>.run.json`: whatever differs from run to run and therefore must not be in the atlas.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "atlas/output.hpp"
#include "atlas/software.hpp"
#include "mpi/job/master.hpp"
#include "plan/part.hpp"

namespace rubatlas::mpi {

/// What is known of a run at its beginning.
struct RunBeginning {
  std::chrono::system_clock::time_point started;
  plan::Part part;                 ///< of the scene's grid
  std::vector<std::string> hosts;  ///< one per rank
  bool resumed = false;
};

/// The path of an atlas' record. It never replaces the files `read`, nor any file but a record. Throws
/// atlas::OutputRefusal.
atlas::Output record_output(const std::filesystem::path& atlas,
                            const std::vector<std::filesystem::path>& read);

/// Writes the record of an atlas that has been merged: the runs of all parts, one after the other. Parts
/// without a record are left out. Throws EnvironmentError.
void merge_records(const atlas::Output& output, const std::vector<std::filesystem::path>& parts);

/// The record beside an atlas. It is written when a run begins and updated while the run goes on, so that a
/// killed run leaves a record too, with null for its end.
class RunRecord {
 public:
  /// A resumed run is appended to the earlier ones; any other run starts a new record. Throws
  /// EnvironmentError.
  RunRecord(atlas::Output output, RunBeginning beginning, atlas::Software software);

  /// Updates the record while the run goes on. A full disk is ignored here, since writing the rows reports
  /// it.
  void update(const JobResult& so_far) const;
  /// Throws EnvironmentError.
  void finish(const JobResult& result, int exit_code) const;

 private:
  void write(const std::string& paragraph) const;

  atlas::Output output_;
  RunBeginning beginning_;
  atlas::Software software_;
  std::string earlier_;  ///< text of the earlier runs in the file
};

}  // namespace rubatlas::mpi

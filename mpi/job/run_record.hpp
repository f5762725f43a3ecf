/// `<atlas>.run.json`: whatever differs from run to run and therefore must not be in the atlas.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "atlas/output.hpp"
#include "atlas/software.hpp"
#include "mpi/job/master.hpp"

namespace rubatlas::mpi {

/// What is known of a run when it begins.
struct RunBeginning {
  std::chrono::system_clock::time_point started;
  std::vector<std::string> hosts;  ///< one per rank
  std::vector<std::string> lanes;  ///< one per rank: lines that it can follow side by side
  bool resumed = false;
};

/// Where the record of an atlas is: never over the scene, and over nothing but a record. Throws
/// atlas::OutputRefusal.
atlas::Output record_output(const std::filesystem::path& atlas, const std::filesystem::path& scene);

/// And when it ends.
struct RunEnding {
  std::vector<std::string> in_lanes;  ///< one per rank: attempts of steps made beside others
  int exit_code = 0;
};

/// The record beside an atlas. It is there from the beginning of a run and brought up to date while that goes
/// on, so that a run that is killed has left its record too: with null where it would say how it ended.
class RunRecord {
 public:
  /// `resumed` runs join those before them, others start the record anew. Throws EnvironmentError.
  RunRecord(atlas::Output output, RunBeginning beginning, atlas::Software software);

  /// While the run goes on. A disk that takes no more is left to the rows to say.
  void update(const JobResult& so_far) const;
  /// Throws EnvironmentError.
  void finish(const JobResult& result, const RunEnding& ending) const;

 private:
  void write(const std::string& paragraph) const;

  atlas::Output output_;
  RunBeginning beginning_;
  atlas::Software software_;
  std::string earlier_;  ///< runs before this one, as they stand in the file
};

/// A text between quotation marks, as JSON wants it.
std::string json_text(const std::string& text);

}  // namespace rubatlas::mpi

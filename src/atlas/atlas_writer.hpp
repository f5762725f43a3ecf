/// An atlas that is being filled: by one process, or by all ranks of a job at once.
///
/// A status of "done" guarantees that the row is in the file, also after a power cut, although the system
/// writes pages to the disk in any order. A row and its checksum are therefore written at once, and its
/// status later in a batch: every few seconds the rows written so far are forced to the disk, and then their
/// statuses are written.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "atlas/hdf5.hpp"
#include "atlas/row_checksum.hpp"
#include "atlas/schema.hpp"
#include "atlas/synchronise.hpp"
#include "point/line_solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::atlas {

class AtlasWriter {
 public:
  /// A run that is killed loses the points that it finished within this time. It is short beside a run, and
  /// long enough that waiting for the disk costs little.
  static constexpr std::chrono::milliseconds kBatchPeriod{2000};

  /// Opens an atlas that `create_atlas` made from the same scene; under MPI all ranks together, each of which
  /// then writes whenever it likes. With a `batch_period` of 0 each status is written right after its row.
  /// Throws EnvironmentError.
  AtlasWriter(const std::filesystem::path& path, const settings::Scene& scene,
              std::chrono::milliseconds batch_period = kBatchPeriod);

  /// Writes a point's row; its status follows when the row is on the disk. A point that did not end as done
  /// gets NaN throughout. `restarted`: it started from the scene's `initial`.
  void write_point(std::size_t point, bool restarted, const point::PointOutcome& outcome);

  /// Writes the statuses of a batch that is due. A rank that writes no points has to call it from time to
  /// time; a call costs a look at the clock.
  void settle_if_due();
  /// Writes all statuses, due or not.
  void settle();

  /// Collective over all ranks. Everything is on the disk when it returns.
  void close();

 private:
  void write_row(std::size_t point, const Row& row);
  template <Number T>
  void write_part(const RowDataset& rows, std::size_t point, std::span<const T> values);

  std::filesystem::path path_;
  Schema schema_;
  Shape grid_shape_;
  File file_;
  Synchroniser disk_;
  std::map<std::string, Dataset> datasets_;
  std::vector<std::pair<std::size_t, std::uint8_t>> unsettled_;  ///< point and status
  std::chrono::milliseconds batch_period_;
  std::chrono::steady_clock::time_point next_batch_;
};

}  // namespace rubatlas::atlas

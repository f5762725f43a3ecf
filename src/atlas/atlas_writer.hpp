/// An atlas that is being filled: by one process, or by all ranks of a job at once.
///
/// Rows are gathered in memory and written together. A status of "done" guarantees that the row is in the
/// file, also after a power cut, although the system writes pages to the disk in any order. Every second the
/// rows are therefore forced to the disk, and only then their statuses are written.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "atlas/final_states.hpp"
#include "atlas/hdf5.hpp"
#include "atlas/row_batch.hpp"
#include "atlas/row_block.hpp"
#include "atlas/schema.hpp"
#include "atlas/synchronise.hpp"
#include "point/line_solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::atlas {

class AtlasWriter {
 public:
  /// A run that is killed loses the points that it finished within this time. It is short beside a run, and
  /// long enough that waiting for the disk costs little.
  static constexpr std::chrono::milliseconds kBatchPeriod{1000};
  /// Rows are gathered up to this size [bytes], though at least one.
  static constexpr std::size_t kMostGathered = std::size_t{1} << 20;

  /// Opens an atlas that `create_atlas` made from the same scene; under MPI all ranks together, each of which
  /// then writes whenever it likes. With a `batch_period` of 0 each status is due right after its row.
  /// Throws EnvironmentError.
  AtlasWriter(const std::filesystem::path& path, const settings::Scene& scene,
              std::chrono::milliseconds batch_period = kBatchPeriod);
  AtlasWriter(const AtlasWriter&) = delete;
  AtlasWriter& operator=(const AtlasWriter&) = delete;

  /// Takes the row of a point and its status, and keeps both in memory. A point that did not end as done gets
  /// NaN throughout.
  void add_point(std::size_t point, const Origin& origin, const point::PointOutcome& outcome);
  /// True when the rows in memory should be written before another is added.
  [[nodiscard]] bool is_full() const { return rows_.bytes() >= kMostGathered; }
  /// Writes the rows in memory, without their statuses: one block of each dataset where the points are
  /// neighbours.
  void write_rows();

  /// True when statuses are due. A rank that adds no points has to ask from time to time too; it costs a look
  /// at the clock.
  [[nodiscard]] bool is_due() const { return std::chrono::steady_clock::now() >= next_batch_; }
  /// Writes the rows in memory, forces all written rows to the disk, and writes their statuses.
  void commit();

  /// The ends of points that were done when the atlas was opened.
  [[nodiscard]] const FinalStates& ends() const { return ends_; }

  /// Collective over all ranks. Everything is on the disk when it returns.
  void close();

 private:
  struct Uncommitted {
    std::size_t point = 0;
    std::uint8_t status = 0;
  };
  void write(std::size_t dataset, const PointBlock& block, std::span<const std::byte> rows);
  void write_statuses();

  std::filesystem::path path_;
  Schema schema_;
  Shape grid_shape_;
  File file_;
  FinalStates ends_;
  Synchroniser disk_;
  std::vector<Dataset> datasets_;  ///< as `Schema::row_datasets`
  RowBatch rows_;
  std::vector<Uncommitted> uncommitted_;  ///< their rows are in the file
  std::chrono::milliseconds batch_period_;
  std::chrono::steady_clock::time_point next_batch_;
};

}  // namespace rubatlas::atlas

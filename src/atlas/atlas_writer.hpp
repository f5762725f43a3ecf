/// An atlas that is being filled: by one process, or by all ranks of a job at once.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "atlas/hdf5.hpp"
#include "atlas/schema.hpp"
#include "scene/scene.hpp"
#include "solve/line_solver.hpp"

namespace rubatlas::atlas {

class AtlasWriter {
 public:
  /// Opens an atlas that `create_atlas` made from the same scene; under MPI all ranks together, each of which
  /// then writes whenever it likes. Throws EnvironmentError.
  AtlasWriter(const std::filesystem::path& path, const scene::Scene& scene);

  /// Writes a point's rows, and its status last: whoever finds the status finds the row. A point that did not
  /// end as done gets NaN throughout. `restarted`: it started from the scene's `initial`.
  void write_point(std::size_t point, bool restarted, const solve::PointOutcome& outcome);

  /// All ranks together.
  void close();

 private:
  void write_rows(std::size_t point, bool restarted, const solve::PointOutcome& outcome);
  template <Number T>
  void write_row(const RowDataset& rows, std::size_t point, std::span<const T> values);

  std::filesystem::path path_;
  Schema schema_;
  Shape grid_shape_;
  File file_;
  std::map<std::string, Dataset> datasets_;
  std::vector<double> absent_;  ///< NaN, as long as the longest row
};

}  // namespace rubatlas::atlas

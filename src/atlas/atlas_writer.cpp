#include "atlas/atlas_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "atlas/environment_error.hpp"
#include "atlas/point_index.hpp"

namespace rubatlas::atlas {
namespace {

constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

template <typename T>
std::span<const T> one(const T& value) {
  return {&value, 1};
}

}  // namespace

AtlasWriter::AtlasWriter(const std::filesystem::path& path, const scene::Scene& scene)
    : path_(path), schema_(schema_of(scene)), file_(File::open_to_write(path)) {
  for (const auto& axis : schema_.axes) grid_shape_.push_back(axis.values.size());
  std::size_t longest = 0;
  for (const auto* rows : schema_.row_datasets()) {
    Dataset dataset = file_.dataset(rows->name);
    if (dataset.shape() != rows->shape) {
      throw EnvironmentError(
          fmt::format("{}: /{} has not the shape that its scene asks for", path.string(), rows->name));
    }
    const auto inner = rows->shape.begin() + static_cast<std::ptrdiff_t>(grid_shape_.size());
    longest =
        std::max(longest, std::accumulate(inner, rows->shape.end(), std::size_t{1}, std::multiplies<>()));
    datasets_.emplace(rows->name, std::move(dataset));
  }
  absent_.assign(longest, kAbsent);
}

template <Number T>
void AtlasWriter::write_row(const RowDataset& rows, std::size_t point, std::span<const T> values) {
  Shape start = point_index(grid_shape_, point);
  Shape count = rows.shape;
  start.resize(count.size(), 0);
  std::fill_n(count.begin(), grid_shape_.size(), std::size_t{1});
  datasets_.at(rows.name).template write_block<T>(start, count, values);
}

void AtlasWriter::write_point(std::size_t point, bool restarted, const solve::PointOutcome& outcome) {
  try {
    write_rows(point, restarted, outcome);
  } catch (const EnvironmentError& error) {
    // Most often the disk is full, which HDF5 over MPI-IO does not say.
    throw EnvironmentError(fmt::format("{} takes no more rows: {}", path_.string(), error.what()));
  }
}

void AtlasWriter::write_rows(std::size_t point, bool restarted, const solve::PointOutcome& outcome) {
  const bool done = outcome.status == solve::PointStatus::done;
  const auto present_or_absent = [&](std::span<const double> values) {
    return done ? values : std::span<const double>(absent_).first(values.size());
  };
  for (std::size_t i = 0; i < schema_.observables.size(); ++i) {
    write_row<double>(schema_.observables[i], point, present_or_absent(outcome.rows[i]));
  }
  write_row<double>(schema_.final_state, point, present_or_absent(outcome.final_state));
  std::span<const double> remembered = outcome.final_memory.view();
  for (const RowDataset& memory : schema_.memories) {
    // A line on which the effect has no strength leaves things as they are.
    const std::size_t size = memory.shape.back();
    const std::vector<double> unchanged(size, 0.0);
    const bool there = remembered.size() >= size;
    write_row<double>(memory, point, present_or_absent(there ? remembered.first(size) : unchanged));
    if (there) remembered = remembered.subspan(size);
  }
  write_row<std::uint8_t>(schema_.restarted, point, one<std::uint8_t>(restarted ? 1 : 0));
  write_row<std::int32_t>(schema_.failed_revolution, point,
                          one<std::int32_t>(done ? -1 : outcome.failed_revolution));
  write_row<std::uint8_t>(schema_.status_detail, point, one(static_cast<std::uint8_t>(outcome.detail)));
  // Last: a reader, and the run that resumes after a kill, believe a row as soon as its status says so.
  write_row<std::uint8_t>(schema_.status, point, one(static_cast<std::uint8_t>(outcome.status)));
}

void AtlasWriter::close() {
  for (auto& [name, dataset] : datasets_) dataset.close();
  file_.close();
}

}  // namespace rubatlas::atlas

#include "atlas/atlas_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

#include "atlas/environment_error.hpp"
#include "atlas/point_index.hpp"

namespace rubatlas::atlas {
namespace {

/// On a slow disk batches become longer, so that waiting for the disk takes at most one part in this many of
/// the time.
constexpr int kPartsOfTime = 20;

template <typename T>
std::span<const T> one(const T& value) {
  return {&value, 1};
}

}  // namespace

AtlasWriter::AtlasWriter(const std::filesystem::path& path, const settings::Scene& scene,
                         std::chrono::milliseconds batch_period)
    : path_(path),
      schema_(schema_of(scene)),
      file_(File::open_to_write(path)),
      disk_(path),
      batch_period_(batch_period),
      next_batch_(std::chrono::steady_clock::now() + batch_period) {
  for (const auto& axis : schema_.axes) grid_shape_.push_back(axis.values.size());
  for (const auto* rows : schema_.row_datasets()) {
    Dataset dataset = file_.dataset(rows->name);
    if (dataset.shape() != rows->shape) {
      throw EnvironmentError(
          fmt::format("{}: /{} has not the shape that its scene asks for", path.string(), rows->name));
    }
    datasets_.emplace(rows->name, std::move(dataset));
  }
}

template <Number T>
void AtlasWriter::write_part(const RowDataset& rows, std::size_t point, std::span<const T> values) {
  Shape start = point_index(grid_shape_, point);
  Shape count = rows.shape;
  start.resize(count.size(), 0);
  std::fill_n(count.begin(), grid_shape_.size(), std::size_t{1});
  try {
    datasets_.at(rows.name).template write_block<T>(start, count, values);
  } catch (const EnvironmentError& error) {
    throw EnvironmentError(
        fmt::format("{} takes no more rows, perhaps since the disk is full or a limit is reached ({})",
                    path_.string(), error.what()));
  }
}

void AtlasWriter::write_point(std::size_t point, bool restarted, const point::PointOutcome& outcome) {
  write_row(point, Row(schema_, restarted, outcome));
  // A reader, and a run that resumes, read a row as soon as its status is "done".
  unsettled_.emplace_back(point, static_cast<std::uint8_t>(outcome.status));
  settle_if_due();
}

void AtlasWriter::write_row(std::size_t point, const Row& row) {
  const auto datasets = schema_.summed_datasets();
  for (std::size_t i = 1; i < datasets.size(); ++i) {  // all but the status
    std::visit(
        [&](const auto& values) {
          if constexpr (requires { values.size(); }) {
            write_part(*datasets[i], point, values);
          } else {
            write_part(*datasets[i], point, one(values));
          }
        },
        row.parts().at(i));
  }
  write_part(schema_.row_checksum, point, one(row.checksum()));
}

void AtlasWriter::settle_if_due() {
  if (std::chrono::steady_clock::now() >= next_batch_) settle();
}

void AtlasWriter::settle() {
  const auto began = std::chrono::steady_clock::now();
  if (!unsettled_.empty()) {
    disk_.synchronise();
    for (const auto& [point, status] : unsettled_) write_part(schema_.status, point, one(status));
    unsettled_.clear();
  }
  const auto ended = std::chrono::steady_clock::now();
  next_batch_ = ended;
  if (batch_period_.count() > 0) {
    next_batch_ +=
        std::max<std::chrono::steady_clock::duration>(batch_period_, kPartsOfTime * (ended - began));
  }
}

void AtlasWriter::close() {
  settle();
  disk_.synchronise();
  for (auto& [name, dataset] : datasets_) dataset.close();
  file_.close();
}

}  // namespace rubatlas::atlas

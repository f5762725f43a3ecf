#include "atlas/atlas_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "atlas/environment_error.hpp"

namespace rubatlas::atlas {
namespace {

/// On a slow disk batches become longer, so that waiting for the disk takes at most one part in this many of
/// the time.
constexpr int kPartsOfTime = 20;

/// The place of the statuses in `Schema::row_datasets`.
constexpr std::size_t kStatus = 0;

/// Calls `use` with each block of consecutive points, and the place of its first point in their list.
template <typename Use>
void for_each_block(const Shape& grid, const Stretch& points, Use use) {
  for (std::size_t done = 0; done < points.count;) {
    const std::size_t first = points.first + done;
    const PointBlock block = block_at(grid, first, points.first + points.count, points.count);
    use(block, points.place + done);
    done += block.count;
  }
}

}  // namespace

AtlasWriter::AtlasWriter(const std::filesystem::path& path, const settings::Scene& scene,
                         std::chrono::milliseconds batch_period)
    : path_(path),
      schema_(schema_of(scene)),
      file_(File::open_to_write(path)),
      ends_(file_, schema_),
      disk_(path),
      rows_(schema_),
      batch_period_(batch_period),
      next_batch_(std::chrono::steady_clock::now() + batch_period) {
  for (const auto& axis : schema_.axes) grid_shape_.push_back(axis.values.size());
  for (const auto* rows : schema_.row_datasets()) {
    Dataset dataset = file_.dataset(rows->name);
    if (dataset.shape() != rows->shape) {
      throw EnvironmentError(
          fmt::format("{}: /{} has not the shape that its scene asks for", path.string(), rows->name));
    }
    datasets_.push_back(std::move(dataset));
  }
}

void AtlasWriter::write(std::size_t dataset, const PointBlock& block, std::span<const std::byte> rows) {
  try {
    const auto [start, count] = place_in(datasets_[dataset], block);
    datasets_[dataset].write_bytes(start, count, rows);
  } catch (const EnvironmentError& error) {
    throw EnvironmentError(
        fmt::format("{} takes no more rows, perhaps since the disk is full or a limit is reached ({})",
                    path_.string(), error.what()));
  }
}

void AtlasWriter::add_point(std::size_t point, const Origin& origin, const point::PointOutcome& outcome) {
  rows_.add(point, origin, outcome);
  uncommitted_.push_back({point, static_cast<std::uint8_t>(outcome.status)});
}

void AtlasWriter::write_rows() {
  for (const Stretch& stretch : rows_.stretches()) {
    for_each_block(grid_shape_, stretch, [&](const PointBlock& block, std::size_t place) {
      // All but the status: a reader, and a run that resumes, read a row as soon as its status is "done".
      for (std::size_t dataset = kStatus + 1; dataset < datasets_.size(); ++dataset) {
        write(dataset, block, rows_.column(dataset, place, block.count));
      }
    });
  }
  rows_.clear();
}

void AtlasWriter::write_statuses() {
  std::ranges::sort(uncommitted_, {}, &Uncommitted::point);
  std::vector<std::uint8_t> statuses;
  for (const auto& uncommitted : uncommitted_) statuses.push_back(uncommitted.status);
  for (const Stretch& stretch : stretches_of(uncommitted_)) {
    for_each_block(grid_shape_, stretch, [&](const PointBlock& block, std::size_t place) {
      write(kStatus, block, std::as_bytes(std::span(statuses)).subspan(place, block.count));
    });
  }
  uncommitted_.clear();
}

void AtlasWriter::commit() {
  const auto began = std::chrono::steady_clock::now();
  if (!uncommitted_.empty()) {
    write_rows();
    disk_.synchronise();
    write_statuses();
  }
  const auto ended = std::chrono::steady_clock::now();
  next_batch_ = ended;
  if (batch_period_.count() > 0) {
    next_batch_ +=
        std::max<std::chrono::steady_clock::duration>(batch_period_, kPartsOfTime * (ended - began));
  }
}

void AtlasWriter::close() {
  commit();
  disk_.synchronise();
  ends_.close();
  for (Dataset& dataset : datasets_) dataset.close();
  file_.close();
}

}  // namespace rubatlas::atlas

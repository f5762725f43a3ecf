/// Rows of consecutive points, read a block at a time: in one call of HDF5 for each dataset, and in little
/// memory whatever the size of the atlas.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "atlas/atlas_reader.hpp"
#include "atlas/hdf5.hpp"
#include "atlas/row_checksum.hpp"

namespace rubatlas::atlas {

/// Consecutive points that are a box of the grid.
struct PointBlock {
  std::size_t first = 0;
  std::size_t count = 0;
  Shape start;   ///< index of the first point along each axis of the grid
  Shape extent;  ///< number of points along each axis of the grid
};

/// The largest block that begins with the point `first`, lies before the point `end`, and has at most `most`
/// points.
PointBlock block_at(const Shape& grid, std::size_t first, std::size_t end, std::size_t most);

/// Largest number of points in a block of this atlas: its rows take a few megabytes, or are those of one
/// point.
std::size_t points_in_block(const AtlasReader& atlas);

/// Calls `use` with each block of the points [first, end) of an atlas, in order, until it returns false; the
/// result is then false.
template <typename Use>
bool for_each_block(const AtlasReader& atlas, std::size_t first, std::size_t end, Use use) {
  const Shape grid = atlas.shape();
  const std::size_t most = points_in_block(atlas);
  while (first < end) {
    const PointBlock block = block_at(grid, first, end, most);
    if (!use(block)) return false;
    first += block.count;
  }
  return true;
}

/// Names of the datasets that a row's checksum covers, in its order.
std::vector<std::string> summed_names(const AtlasReader& atlas);

/// Start and extent of a block in a dataset whose inner axes follow those of the grid.
std::pair<Shape, Shape> place_in(const Dataset& dataset, const PointBlock& block);

/// Calls `use` with the rows of a block in one dataset: a vector of the dataset's own number type.
template <typename Use>
void with_rows(const Dataset& dataset, const PointBlock& block, Use use) {
  const auto [start, count] = place_in(dataset, block);
  if (dataset.holds<double>()) return use(dataset.read_block<double>(start, count));
  if (dataset.holds<std::int32_t>()) return use(dataset.read_block<std::int32_t>(start, count));
  if (dataset.holds<std::uint32_t>()) return use(dataset.read_block<std::uint32_t>(start, count));
  if (dataset.holds<std::uint16_t>()) return use(dataset.read_block<std::uint16_t>(start, count));
  use(dataset.read_block<std::uint8_t>(start, count));
}

/// The checksums of the rows of a block, accumulated dataset by dataset.
class BlockSums {
 public:
  explicit BlockSums(std::size_t point_count) : sums_(point_count) {}

  /// The rows of all points of the block in one dataset.
  template <typename T>
  void add(std::span<const T> rows) {
    const std::size_t size = rows.size() / sums_.size();
    for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i].add(rows.subspan(i * size, size));
  }
  [[nodiscard]] std::uint32_t at(std::size_t i) const { return sums_[i].value(); }

 private:
  std::vector<RowChecksum> sums_;
};

}  // namespace rubatlas::atlas

#include "atlas/row_block.hpp"

#include <algorithm>
#include <sstream>

#include "atlas/point_index.hpp"

namespace rubatlas::atlas {
namespace {

constexpr std::size_t kBytesOfBlock = std::size_t{2} << 20;
/// For rows of a few bytes: the checksums of a block take memory too.
constexpr std::size_t kMostPoints = std::size_t{1} << 16;

}  // namespace

PointBlock block_at(const Shape& grid, std::size_t first, std::size_t end, std::size_t most) {
  const std::size_t room = std::min(end - first, most);
  // `inside` is the number of points at one index of `axis`. A block goes along the outermost axis at whose
  // index it begins with the first point inside, as long as the points inside have room.
  std::size_t axis = grid.size() - 1;
  std::size_t inside = 1;
  while (axis > 0 && first % (inside * grid[axis]) == 0 && inside * grid[axis] <= room) {
    inside *= grid[axis];
    --axis;
  }
  PointBlock block{.first = first, .start = point_index(grid, first), .extent = Shape(grid.size(), 1)};
  block.extent[axis] = std::min(room / inside, grid[axis] - block.start[axis]);
  std::copy(grid.begin() + static_cast<std::ptrdiff_t>(axis) + 1, grid.end(),
            block.extent.begin() + static_cast<std::ptrdiff_t>(axis) + 1);
  block.count = product(block.extent);
  return block;
}

std::vector<std::string> summed_names(const AtlasReader& atlas) {
  std::istringstream order(atlas.file().dataset("row_checksum").text("order"));
  std::vector<std::string> names;
  for (std::string name; order >> name;) names.push_back(name);
  return names;
}

std::pair<Shape, Shape> place_in(const Dataset& dataset, const PointBlock& block) {
  Shape start = block.start;
  Shape count = dataset.shape();
  start.resize(count.size(), 0);
  std::copy(block.extent.begin(), block.extent.end(), count.begin());
  return {start, count};
}

std::size_t points_in_block(const AtlasReader& atlas) {
  const std::size_t points = std::max<std::size_t>(atlas.point_count(), 1);
  std::size_t bytes = 1;
  for (const auto& name : summed_names(atlas)) {
    const Dataset dataset = atlas.file().dataset(name);
    bytes += dataset.size() / points * dataset.number_size();
  }
  return std::clamp<std::size_t>(kBytesOfBlock / bytes, 1, kMostPoints);
}

}  // namespace rubatlas::atlas

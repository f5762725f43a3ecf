// Blocks of consecutive points: boxes of the grid, one after the other, as large as they may be.
#include <gtest/gtest.h>

#include "atlas/point_index.hpp"
#include "atlas/row_block.hpp"

namespace rubatlas::atlas {
namespace {

TEST(PointBlocks, AreBoxesThatFollowEachOtherWithoutGapOrOverlap) {
  const Shape grid{2, 3, 1, 4, 5};
  const std::size_t points = product(grid);
  for (std::size_t begin = 0; begin < points; begin += 7) {
    for (std::size_t end = begin + 1; end <= points; end += 9) {
      for (const std::size_t most : {1U, 3U, 5U, 17U, 20U, 65U, 1000U}) {
        for (std::size_t first = begin; first < end;) {
          const PointBlock block = block_at(grid, first, end, most);
          EXPECT_EQ(block.start, point_index(grid, first));
          EXPECT_EQ(block.count, product(block.extent));
          EXPECT_GE(block.count, 1U);
          EXPECT_LE(block.count, std::min(most, end - first));
          // The last corner of the box is the last point: the box has consecutive points.
          Shape last = point_index(grid, first + block.count - 1);
          for (std::size_t axis = 0; axis < grid.size(); ++axis) {
            EXPECT_EQ(last[axis], block.start[axis] + block.extent[axis] - 1);
          }
          first += block.count;
        }
      }
    }
  }
}

TEST(PointBlocks, CoverManyShortLinesAtOnce) {
  EXPECT_EQ(block_at({100, 50, 1}, 0, 5000, 5000).count, 5000U);
  EXPECT_EQ(block_at({100, 50, 1}, 50, 5000, 1024).count, 1000U);
  EXPECT_EQ(block_at({100, 50, 1}, 60, 5000, 1024).count, 40U);
  EXPECT_EQ(block_at({100, 50, 1}, 0, 5000, 30).count, 30U);
}

}  // namespace
}  // namespace rubatlas::atlas

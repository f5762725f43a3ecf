// Parts of a grid: every line in one of them, and a text for each.
#include <gtest/gtest.h>

#include <algorithm>

#include "plan/part.hpp"

namespace rubatlas::plan {
namespace {

TEST(Part, EveryLineIsInOnePartAndTheirSizesDifferByOneLineAtMost) {
  constexpr std::size_t kSpeeds = 7;
  for (std::size_t lines = 1; lines < 40; ++lines) {
    for (std::size_t count = 1; count <= lines; ++count) {
      std::size_t end = 0;
      std::size_t fewest = lines;
      std::size_t most = 0;
      for (std::size_t number = 1; number <= count; ++number) {
        const auto points = points_of({number, count}, lines, kSpeeds);
        EXPECT_EQ(points.first, end);
        EXPECT_EQ(points.first % kSpeeds, 0U);
        end = points.end;
        fewest = std::min(fewest, points.count() / kSpeeds);
        most = std::max(most, points.count() / kSpeeds);
      }
      EXPECT_EQ(end, lines * kSpeeds);
      EXPECT_GE(fewest, 1U);
      EXPECT_LE(most, fewest + 1);
    }
  }
}

TEST(Part, ItsTextIsReadBackAndNothingElseIs) {
  EXPECT_EQ(read_part(text_of({2, 8})), (Part{2, 8}));
  EXPECT_EQ(read_part("1/1"), Part{});
  EXPECT_TRUE(Part{}.is_whole());
  for (const char* text : {"", "/", "2", "2/", "/8", "0/8", "9/8", "2/8/", "2 /8", "-2/8", "+2/8", "2.0/8",
                           "2/1000001", "99999999999999999999/8"}) {
    EXPECT_FALSE(read_part(text)) << text;
  }
}

}  // namespace
}  // namespace rubatlas::plan

#include <gtest/gtest.h>

#include <array>
#include <string_view>

#include "settings/nearest.hpp"

namespace rubatlas::settings {
namespace {

TEST(NearestWord, CountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(edit_distance("", ""), 0U);
  EXPECT_EQ(edit_distance("", "ring"), 4U);
  EXPECT_EQ(edit_distance("friction", "friction"), 0U);
  EXPECT_EQ(edit_distance("fricton", "friction"), 1U);
  EXPECT_EQ(edit_distance("frriction", "friction"), 1U);
  EXPECT_EQ(edit_distance("frictiom", "friction"), 1U);
  EXPECT_EQ(edit_distance("firction", "friction"), 1U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
}

TEST(NearestWord, IsTheFirstOfEquals) {
  static constexpr std::array<std::string_view, 3> kWords{"x", "y", "vx"};
  EXPECT_EQ(nearest("z", kWords), "x");
  EXPECT_EQ(nearest("vxx", kWords), "vx");
}

}  // namespace
}  // namespace rubatlas::settings

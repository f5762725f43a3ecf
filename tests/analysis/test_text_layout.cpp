// How texts for a terminal are laid out.
#include "analysis/text_layout.hpp"

#include <gtest/gtest.h>

namespace rubatlas::analysis {
namespace {

TEST(TextLayout, BreaksBetweenWordsButNotWithinAQuantity) {
  EXPECT_EQ(paragraph("  a", "one two three", 5, 12), "  a  one two\n     three\n");
  EXPECT_EQ(paragraph(" ", "falls to 17 mm at ζ = 0.1", 2, 14), "   falls to\n  17 mm at\n  ζ = 0.1\n");
}

TEST(TextLayout, CountsCharactersNotBytes) {
  EXPECT_EQ(character_count("ζ × Ω"), 5U);
  EXPECT_EQ(padded("ζ", 4), "ζ   ");
  EXPECT_EQ(padded("long", 3), "long  ");
}

}  // namespace
}  // namespace rubatlas::analysis

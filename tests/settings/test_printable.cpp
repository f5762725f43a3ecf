#include <gtest/gtest.h>

#include "settings/printable.hpp"

namespace rubatlas::settings {
namespace {

TEST(Printable, WordsStayAsTheyAre) {
  EXPECT_EQ(printable("Ω = 0.62, ζ in € and 𝛺: \"x\""), "Ω = 0.62, ζ in € and 𝛺: \"x\"");
}

TEST(Printable, ControlCharactersOfBothSetsAreLeftOut) {
  EXPECT_EQ(printable("a\x1b[31mb\x07\nc\x7f"
                      "d\xc2\x9b"
                      "e\xc2\xa0"
                      "f"),
            "a[31mbcde\xc2\xa0"
            "f");
}

TEST(Printable, WhatIsNoUtf8BecomesAQuestionMark) {
  EXPECT_EQ(printable("a\xee"
                      "b"),
            "a?b");
  EXPECT_EQ(printable("\xff\xc0"), "??");
  EXPECT_EQ(printable("end\xe2\x82"), "end??");
}

}  // namespace
}  // namespace rubatlas::settings

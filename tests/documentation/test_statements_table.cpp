// The table in analysis/paper/statements.md is the program's own: where this test fails, it prints the text
// that belongs between the two marks.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "analysis/paper/paper_statements.hpp"
#include "page.hpp"

namespace rubatlas::analysis {
namespace {

std::string table() {
  std::string text = "| | rotor | what the paper says | judged on |\n|---|---|---|---|\n";
  for (const auto& statement : paper_statements()) {
    text += fmt::format("| {} | {} | {} | {} |\n", statement.name, statement.rotor, statement.claim,
                        statement.judged);
  }
  return text;
}

TEST(StatementsTable, ThePageShowsTheTableOfTheList) {
  const std::string shown = documentation::between_marks("analysis/paper/statements.md", "statements");
  EXPECT_EQ(shown, table()) << "\nbetween the marks belongs:\n" << table();
}

TEST(StatementsTable, NumbersThemWithoutAGap) {
  int number = 0;
  for (const auto& statement : paper_statements()) EXPECT_EQ(statement.name, fmt::format("P{}", ++number));
  EXPECT_EQ(number, 16);
  EXPECT_EQ(claim_of("P3"), "then region 3, periodic");
  EXPECT_THROW(static_cast<void>(claim_of("P17")), std::out_of_range);
}

}  // namespace
}  // namespace rubatlas::analysis

// The table of the scene's keys in src/settings/keys.md is the reader's own table: where this test fails,
// it prints the text that belongs between the two marks.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <variant>

#include "page.hpp"
#include "settings/observable_names.hpp"
#include "settings/quantity.hpp"

namespace rubatlas::settings {
namespace {

std::string text(const Value& value) {
  if (std::holds_alternative<double>(value)) return fmt::format("{:g}", std::get<double>(value));
  if (std::holds_alternative<int>(value)) return fmt::format("{}", std::get<int>(value));
  if (std::holds_alternative<bool>(value)) return std::get<bool>(value) ? "true" : "false";
  if (std::holds_alternative<std::string>(value)) return std::get<std::string>(value);
  return "none";  // a list
}

/// A scene in which a quantity is not absent, so that it shows its default.
Scene with(const Quantity& entry) {
  Scene scene;
  for (const auto& section : sections()) {
    if (section.open != nullptr) section.open(scene);
  }
  if (!entry.chooser.empty()) quantity(entry.chooser).write(scene, Value{std::string(entry.readers.front())});
  return scene;
}

std::string default_text(const Quantity& quantity) {
  if (!quantity.default_rule.empty()) return std::string(quantity.default_rule);
  if (const auto value = quantity.read(Scene{})) return text(*value);
  return text(quantity.read(with(quantity)).value()) + " where it applies, else absent";
}

std::string range_text(const Range& range) {
  return fmt::format("{}{:g}, {:g}{}", range.low_excluded ? '(' : '[', range.low, range.high,
                     range.high_excluded ? ')' : ']');
}

std::string allowed_text(const Quantity& quantity) {
  if (quantity.kind == Kind::text) return "any text";
  if (quantity.kind == Kind::numbers) return "a list in " + range_text(quantity.range);
  if (quantity.kind == Kind::flag) return "`true`, `false`";
  if (quantity.kind != Kind::choice) return range_text(quantity.range);
  std::string words;
  for (const auto& word : quantity.choices) words += fmt::format("{}`{}`", words.empty() ? "" : ", ", word);
  return words;
}

constexpr std::size_t kLineWidth = 120;  ///< of the pages [columns]

std::string table() {
  std::string text = "| key | symbol | meaning | unit | allowed | default |\n|---|---|---|---|---|---|\n";
  for (const auto& quantity : quantities()) {
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", quantity.pointer, quantity.symbol,
                        quantity.meaning, quantity.unit == "1" ? "-" : quantity.unit, allowed_text(quantity),
                        default_text(quantity));
  }
  text += "\nAxes of `grid`: ";
  const auto axes = grid_axes();
  for (std::size_t i = axes.size(); i-- > 0;)
    text += fmt::format("`{}`{}", axes[i].name, i == 0 ? ".\n" : ", ");
  const auto names = observable_names();
  const auto defaults = default_observable_names();
  std::string line = "Observables:";
  text += "\n";
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool kept = std::find(defaults.begin(), defaults.end(), names[i]) != defaults.end();
    const std::string word =
        fmt::format("{0}`{1}`{0}{2}", kept ? "**" : "", names[i], i + 1 == names.size() ? "." : ",");
    if (line.size() + 1 + word.size() > kLineWidth) {
      text += line + "\n";
      line = word;
    } else {
      line += " " + word;
    }
  }
  text += line + "\n";
  return text;
}

TEST(SceneKeys, ThePageShowsTheTableOfTheReader) {
  const std::string shown = documentation::between_marks("src/settings/keys.md", "scene keys");
  EXPECT_EQ(shown, table()) << "\nbetween the marks belongs:\n" << table();
}

}  // namespace
}  // namespace rubatlas::settings

// The table of effects in src/settings/effects/equations.md is the list's own: where this test fails, it
// prints the text that belongs between the two marks.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "page.hpp"
#include "settings/effects/list.hpp"

namespace rubatlas::effects {
namespace {

std::string table() {
  std::string text =
      "| section | what | equation | source | flight | invariants that it breaks |\n"
      "|---|---|---|---|---|---|\n";
  for_each_effect([&]<auto Effect>() {
    const Description& effect = Settings<Effect>::kDescription;
    text +=
        fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", effect.section, effect.meaning, effect.equation,
                    effect.source, effect.flight, effect.breaks.empty() ? "none" : effect.breaks);
  });
  return text;
}

TEST(EffectsTable, ThePageShowsTheTableOfTheList) {
  const std::string shown = documentation::between_marks("src/settings/effects/equations.md", "effects");
  EXPECT_EQ(shown, table()) << "\nbetween the marks belongs:\n" << table();
}

TEST(EffectsTable, TheReadmeLinksToSceneAndPictureOfEveryEffect) {
  const std::string page = documentation::text_of("src/settings/effects/README.md");
  for_each_effect([&]<auto Effect>() {
    std::string name(Settings<Effect>::kDescription.section.substr(1));
    std::replace(name.begin(), name.end(), '/', '_');
    for (const auto& link :
         {"](../../../tools/pictures/effect_" + name + ".png)", "](../../../jobs/effect_" + name + ".json)"})
      EXPECT_NE(page.find(link), std::string::npos) << link;
  });
}

}  // namespace
}  // namespace rubatlas::effects

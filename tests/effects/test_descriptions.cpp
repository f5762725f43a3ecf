// Every effect of the list: what it says of itself, and what the reader makes of it. Nothing here names one.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "../settings/scene_error_text.hpp"
#include "effect_scene.hpp"

namespace rubatlas::test {
namespace {

using nlohmann::json;
using settings::Kind;
using settings::Quantity;

/// A scene that says one thing more.
std::string refusal_of(std::string_view pointer, const json& value) {
  json scene = json::parse(R"({"grid": {"speed_ratio": 0.5}})");
  scene[json::json_pointer(std::string(pointer))] = value;
  return settings::refusal(scene.dump());
}

bool is_number(const Quantity& entry) {
  return entry.kind == Kind::number || entry.kind == Kind::whole_number;
}

double number(const settings::Value& value) {
  if (std::holds_alternative<int>(value)) return std::get<int>(value);
  return std::get<double>(value);
}

TEST(EveryEffect, SaysWhatItIsWhereItComesFromAndWhatBecomesOfFlight) {
  std::set<std::string_view> sections;
  for (const effects::Listed& effect : effects::listed()) {
    SCOPED_TRACE(name_of(effect));
    const effects::Description& description = effect.description;
    EXPECT_TRUE(description.section.starts_with('/'));
    EXPECT_NE(description.meaning, "");
    EXPECT_NE(description.equation, "");
    EXPECT_NE(description.source, "");
    EXPECT_NE(description.flight, "");
    EXPECT_TRUE(sections.insert(description.section).second) << "two effects in one section";
  }
  EXPECT_GE(sections.size(), 5U);
}

TEST(EveryEffect, HasAllOfItsQuantitiesInItsSection) {
  effects::for_each_effect([]<auto Effect>() {
    using Settings = effects::Settings<Effect>;
    EXPECT_EQ(quantities_of(Settings::kDescription.section).size(),
              std::tuple_size_v<decltype(Settings::quantities())>);
  });
}

TEST(EveryEffect, DescribesItsQuantitiesWithDefaultsInRange) {
  for (const effects::Listed& effect : effects::listed()) {
    SCOPED_TRACE(name_of(effect));
    const auto entries = quantities_of(effect.description.section);
    settings::Scene present;
    effect.add(present);
    for (const Quantity* entry : entries) {
      SCOPED_TRACE(entry->pointer);
      EXPECT_NE(entry->meaning, "");
      EXPECT_NE(entry->source, "");
      EXPECT_FALSE(entry->read(settings::Scene{}).has_value()) << "there without the section";
      const auto value = entry->read(present);
      if (!is_number(*entry)) continue;
      EXPECT_NE(entry->unit, "") << R"("1" for a number without)";
      ASSERT_TRUE(value.has_value());
      EXPECT_TRUE(entry->range.contains(number(*value))) << number(*value);
      EXPECT_LT(entry->range.low, entry->range.high);
    }
  }
}

TEST(EveryEffect, IsOffWithoutItsSection) {
  const auto plain = settings::parse_scene(R"({"grid": {"speed_ratio": 0.5}})");
  for (const effects::Listed& effect : effects::listed()) {
    EXPECT_FALSE(effect.is_in(plain)) << name_of(effect);
    EXPECT_FALSE(effect.acts(plain)) << name_of(effect);
  }
}

TEST(EveryEffect, RefusesWhatIsOutOfRangeOrOfAnotherType) {
  for (const effects::Listed& effect : effects::listed()) {
    for (const Quantity* entry : quantities_of(effect.description.section)) {
      SCOPED_TRACE(entry->pointer);
      const std::string pointer(entry->pointer);
      const std::string meaning(entry->meaning);
      const auto expect = [&](const json& value, const std::string& found) {
        const std::string text = refusal_of(pointer, value);
        EXPECT_EQ(text.rfind(pointer + ": ", 0), 0U) << text;
        EXPECT_NE(text.find(found), std::string::npos) << text;
        EXPECT_NE(text.find(meaning), std::string::npos) << text;
      };
      if (is_number(*entry)) {
        expect("much",
               entry->kind == Kind::number ? "\"much\" is not a number" : "\"much\" is not a whole number");
        expect(2.0 * entry->range.high + 1.0, "is outside ");
        expect(entry->range.low - std::abs(entry->range.low) - 1.0, "is outside ");
      } else {
        expect(json::object(), "{} is not ");
      }
    }
  }
}

TEST(EveryEffect, RefusesAKeyThatItDoesNotKnowAndASectionThatIsNone) {
  for (const effects::Listed& effect : effects::listed()) {
    SCOPED_TRACE(name_of(effect));
    const std::string section(effect.description.section);
    std::string known;
    for (const Quantity* entry : quantities_of(section)) {
      known += fmt::format("{}{}", known.empty() ? "" : ", ", entry->key());
    }
    EXPECT_EQ(
        refusal_of(section + "/zzz", 1)
            .rfind(fmt::format("{0}/zzz: unknown key, with the value 1; known in {0}: {1}", section, known),
                   0),
        0U)
        << refusal_of(section + "/zzz", 1);
    EXPECT_EQ(refusal_of(section, 3.5),
              fmt::format("{}: 3.5 is not a section in braces; {}", section, effect.description.meaning));
  }
}

TEST(EveryEffect, HasItsSceneInJobsAndItsPicture) {
  for (const effects::Listed& effect : effects::listed()) {
    const std::string stem = "effect_" + name_of(effect);
    EXPECT_TRUE(std::filesystem::exists(RUBATLAS_SOURCE_DIR "/jobs/" + stem + ".json"))
        << "missing: jobs/" << stem << ".json, a small scene in which the effect acts";
    EXPECT_TRUE(std::filesystem::exists(RUBATLAS_SOURCE_DIR "/tools/pictures/" + stem + ".png"))
        << "missing: tools/pictures/" << stem << ".png; jobs/effects.sh draws it";
  }
}

}  // namespace
}  // namespace rubatlas::test

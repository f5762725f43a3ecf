// The identifier of an atlas: a UUID of version 5 that the motions of its scene decide alone.
#include "settings/identifier.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>

#include "settings/reader.hpp"

namespace rubatlas::settings {
namespace {

std::string identifier(const std::string& additions) {
  return identifier_of(parse_scene(R"({"grid": {"speed_ratio": [0.5, 0.6]})" + additions + "}"));
}

TEST(Identifier, IsAUuidOfVersionFive) {
  const std::regex form("urn:uuid:[0-9a-f]{8}-[0-9a-f]{4}-5[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}");
  EXPECT_TRUE(std::regex_match(identifier(""), form)) << identifier("");
}

TEST(Identifier, IsThatOfTheMotionsWhateverNamesTheAtlasAndHoweverTheSceneIsWritten) {
  const std::string plain = identifier("");
  EXPECT_EQ(identifier(R"(, "title": "t", "reference": "r", "creator": "c", "license": "l")"), plain);
  EXPECT_EQ(identifier(R"(, "rotor": {"mass": 1.0}, "sweep": "up")"), plain) << "defaults";
  EXPECT_EQ(
      identifier_of(parse_scene(resolved_json(parse_scene(R"({"grid": {"speed_ratio": [0.5, 0.6]}})")))),
      plain);
}

TEST(Identifier, OfAnotherSceneIsAnother) {
  const std::set<std::string> different{
      identifier(""), identifier(R"(, "rotor": {"mass": 1.0000000000000002})"),
      identifier(R"(, "sweep": "down")"), identifier(R"(, "gravity": {"acceleration": 0.0})"),
      identifier(R"(, "observables": ["poincare"])")};
  EXPECT_EQ(different.size(), 5U);
}

}  // namespace
}  // namespace rubatlas::settings

// Whatever is in the file, the reader ends with a scene or with a SceneError, and a scene that it accepts is
// one that its own canonical text describes.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "settings/reader.hpp"

namespace rubatlas::settings {
namespace {

using nlohmann::json;

const std::string kScene =
    R"({"title": "t", "rotor": {"mass": 1.0, "damping_ratio": 0.1, "misalignment": 0.01001},
  "blades": {"count": 3, "length": 0.1, "hub_radius": 0.0}, "ring": {"radius": 0.11}, "contact": {"law": "elastica",
  "friction": 0.1}, "unbalance": {"moment": 1e-5, "phase": 0.0}, "grid": {"speed_ratio": {"from": 0.05, "to": 0.95,
  "count": 10}, "damping_ratio": [0.05, 0.1]}, "sweep": "up", "protocol": {"transient_revolutions": 2},
  "spectrum": {"max_order": 12}, "validity": {"max_shortening": 0.5}, "observables": ["poincare", "spectrum"]})";

/// True when accepted. Any other exception than SceneError escapes and fails the test.
bool accepted(const std::string& text) {
  try {
    const std::string resolved = resolved_json(parse_scene(text));
    EXPECT_EQ(resolved_json(parse_scene(resolved)), resolved) << text;
    return true;
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()), "");
    return false;
  }
}

TEST(MutatedScenes, BytesThatAreReplacedRemovedOrAddedNeverCrashTheReader) {
  std::mt19937 random(20160411);
  const auto below = [&](std::size_t bound) { return static_cast<std::size_t>(random() % bound); };
  const std::string letters = "0123456789.eE+-{}[],:\"\\ antrufl\n\x80\xff";
  int legal = 0;
  int refused = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::string text = kScene;
    for (std::size_t change = 0; change <= below(3); ++change) {
      const std::size_t at = below(text.size());
      switch (below(4)) {
        case 0:
          text[at] = letters[below(letters.size())];
          break;
        case 1:
          text.erase(at, 1 + below(5));
          break;
        case 2:
          text.insert(at, 1, letters[below(letters.size())]);
          break;
        default:
          text.insert(at, text.substr(below(text.size()), below(20)));
          break;
      }
    }
    ++(accepted(text) ? legal : refused);
  }
  EXPECT_GT(legal, 20);
  EXPECT_GT(refused, 200);
}

/// Every place in a tree, the root excepted.
void places(json& node, std::vector<json*>& found) {
  for (auto& member : node) {
    found.push_back(&member);
    if (member.is_structured()) places(member, found);
  }
}

TEST(MutatedScenes, ValuesOfAnyKindInAnyPlaceNeverCrashTheReader) {
  std::mt19937 random(86);
  const std::vector<json> values{json(nullptr),
                                 json(true),
                                 json(-1),
                                 json(0),
                                 json(0.0),
                                 json(-0.0),
                                 json(1e308),
                                 json(-1e308),
                                 json(5e-324),
                                 json(3.5),
                                 json(18446744073709551615U),
                                 json(""),
                                 json("elastic_ring"),
                                 json("poincare"),
                                 json::array(),
                                 json::object(),
                                 json::array({0.1, 0.2}),
                                 json::array({"a"}),
                                 json::array({json::array()}),
                                 json{{"from", 0.1}, {"to", 0.2}, {"count", 3}},
                                 json{{"count", 1e18}}};
  int legal = 0;
  int refused = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    json document = json::parse(kScene);
    std::vector<json*> all;
    places(document, all);
    *all[random() % all.size()] = values[random() % values.size()];
    ++(accepted(document.dump()) ? legal : refused);
  }
  EXPECT_GT(legal, 20);
  EXPECT_GT(refused, 200);
}

TEST(MutatedScenes, EveryBeginningOfASceneIsRefused) {
  for (std::size_t size = 0; size < kScene.size(); ++size)
    EXPECT_FALSE(accepted(kScene.substr(0, size))) << size;
}

}  // namespace
}  // namespace rubatlas::settings

// The canonical text: complete, stable, read back as the same scene, and what makes two scenes different.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "settings/quantity.hpp"
#include "settings/reader.hpp"

namespace rubatlas::settings {
namespace {

const std::string kFull = R"({
  "title": "Ω \"quoted\"", "reference": "none", "creator": "an institute", "license": "CC-BY-4.0",
  "rotor": {"mass": 0.3, "natural_frequency": 190, "damping_ratio": 0.07, "misalignment": 0.0123},
  "blades": {"count": 4, "length": 0.1, "width": 0.011, "thickness": 0.0007,
             "youngs_modulus": 7.1e10, "hub_radius": 0.02},
  "ring": {"radius": 0.131, "stiffness": 3e4},
  "contact": {"law": "elastic_ring", "friction": 0.25},
  "unbalance": {"moment": 3e-5, "phase": -1.5},
  "grid": {"speed_ratio": {"from": 0.1, "to": 0.7, "count": 7}, "unbalance": [0, 1e-5], "friction": 0.3},
  "sweep": "both",
  "initial": {"x": 1e-3, "y": -1e-3, "vx": 0.1, "vy": 0.3},
  "protocol": {"transient_revolutions": 0, "sampled_revolutions": 3, "samples_per_revolution": 100},
  "spectrum": {"max_order": 50},
  "validity": {"max_shortening": 0.1, "yield_strain": 0.002},
  "observables": ["spectrum", "max_root_strain"],
  "accuracy": {"method": "paper", "tolerance": 1e-12, "force_increment": 0.5, "max_step": 0.125}})";
const std::string kShort = R"({"grid": {"speed_ratio": 0.5}})";

TEST(ResolvedScene, ReadBackGivesTheSameBytes) {
  for (const auto& text : {kFull, kShort}) {
    const std::string resolved = resolved_json(parse_scene(text));
    EXPECT_EQ(resolved_json(parse_scene(resolved)), resolved);
  }
}

TEST(ResolvedScene, ReadBackGivesTheSameValues) {
  for (const auto& text : {kFull, kShort}) {
    const Scene scene = parse_scene(text);
    const Scene again = parse_scene(resolved_json(scene));
    for (const auto& entry : quantities()) {
      if (entry.read == nullptr) continue;
      EXPECT_EQ(entry.read(scene), entry.read(again)) << entry.pointer;
    }
    for (const auto& axis : grid_axes())
      EXPECT_EQ(scene.grid.*axis.values, again.grid.*axis.values) << axis.name;
    EXPECT_EQ(scene.observables, again.observables);
    EXPECT_EQ(scene.unbalance.has_value(), again.unbalance.has_value());
    EXPECT_EQ(scene.validity.yield_strain.has_value(), again.validity.yield_strain.has_value());
  }
}

TEST(ResolvedScene, DoesNotDependOnHowTheSceneIsWritten) {
  const Scene a = parse_scene(R"({"sweep": "up", "rotor": {"mass": 1, "damping_ratio": 1e-1},
                                  "grid": {"speed_ratio": {"from": 0.25, "to": 0.75, "count": 3}},
                                  "initial": {"x": -0.0}})");
  const Scene b =
      parse_scene(R"({"grid":{"speed_ratio":[0.25,0.5,0.75]},"rotor":{"damping_ratio":0.10,"mass":1.0}})");
  EXPECT_EQ(resolved_json(a), resolved_json(b));
}

TEST(ResolvedScene, WritesEveryDefaultAndEveryAxis) {
  const Scene scene = parse_scene(kFull);
  const auto document = nlohmann::json::parse(resolved_json(scene));
  std::size_t written = 0;
  for (const auto& entry : quantities()) {
    if (entry.read != nullptr && entry.read(scene)) {
      ++written;
      EXPECT_TRUE(document.contains(nlohmann::json::json_pointer(std::string(entry.pointer))))
          << entry.pointer;
    }
  }
  const auto absent = std::ranges::count_if(quantities(), [&](const Quantity& entry) {
    return !entry.section().empty() &&
           !document.contains(nlohmann::json::json_pointer(std::string(entry.section())));
  });
  // Speed lives on the grid, and the `fixed` has a knob of its own.
  EXPECT_EQ(written, quantities().size() - static_cast<std::size_t>(absent) - 2);
  for (const auto& axis : grid_axes())
    EXPECT_TRUE(document["grid"][std::string(axis.name)].is_array()) << axis.name;
  EXPECT_EQ(document["grid"]["speed_ratio"].size(), 7U);
}

TEST(ResolvedScene, WhatIsAbsentStaysAbsent) {
  const auto document = nlohmann::json::parse(resolved_json(parse_scene(kShort)));
  EXPECT_FALSE(document.contains("unbalance"));
  EXPECT_FALSE(document["grid"].contains("unbalance"));
  EXPECT_FALSE(document.contains("creator"));
  EXPECT_FALSE(document.contains("license"));
  EXPECT_FALSE(document["ring"].contains("stiffness"));
  EXPECT_FALSE(document["validity"].contains("yield_strain"));
  EXPECT_EQ(document["accuracy"], (nlohmann::json{{"method", "collocation"}, {"tolerance", 1e-9}}));
}

TEST(ResolvedScene, OfAnOlderProgramSweepsLinesWholeAndSettlesNever) {
  const auto of_speeds = [](int count) {
    return fmt::format(R"({{"grid": {{"speed_ratio": {{"from": 0.1, "to": 0.9, "count": {}}}}}, )"
                       R"("protocol": {{"stop_when_periodic": true}}}})",
                       count);
  };
  EXPECT_EQ(parse_scene(of_older_program(of_speeds(256), false)).protocol.settle, Settle::never);
  const std::string longer = of_older_program(of_speeds(257), false);
  EXPECT_FALSE(parse_scene(longer).pieces);
  EXPECT_EQ(of_older_program(longer, true), longer);
  EXPECT_TRUE(nlohmann::json::parse(longer).at("pieces").is_null());
  EXPECT_FALSE(nlohmann::json::parse(of_older_program(of_speeds(256), false)).contains("pieces"));
}

TEST(Pieces, AreOfLongLinesUnlessTheLinesOfASceneAreMany) {
  const auto is_cut = [](int speeds, int lines, const std::string& rest) {
    return parse_scene(fmt::format(R"({{"grid": {{"speed_ratio": {{"from": 0.1, "to": 0.9, "count": {}}},
                                        "damping_ratio": {{"from": 0.1, "to": 0.2, "count": {}}}}}{}}})",
                                   speeds, lines, rest))
        .pieces.has_value();
  };
  EXPECT_TRUE(is_cut(257, 127, ""));
  EXPECT_FALSE(is_cut(256, 127, ""));
  EXPECT_FALSE(is_cut(257, 128, ""));
  EXPECT_TRUE(is_cut(257, 63, R"(, "sweep": "both")"));
  EXPECT_FALSE(is_cut(257, 64, R"(, "sweep": "both")")) << "up and down are two lines";
  EXPECT_TRUE(is_cut(257, 128, R"(, "pieces": {})")) << "asked for";
}

TEST(SceneDifference, IsEmptyForTheSameMotion) {
  const std::string titled =
      resolved_json(parse_scene(R"({"title": "x", "reference": "y", "creator": "z", "license": "none",
                                    "grid": {"speed_ratio": 0.5}})"));
  EXPECT_EQ(difference(titled, resolved_json(parse_scene(kShort))), "");
}

TEST(SceneDifference, NamesThePointerAndBothValues) {
  const auto resolved = [](const std::string& addition) {
    return resolved_json(parse_scene(R"({"grid": {"speed_ratio": [0.5, 0.6]}, )" + addition + "}"));
  };
  const std::string plain = resolved(R"("sweep": "up")");
  EXPECT_EQ(difference(plain, resolved(R"("rotor": {"mass": 2.5})")),
            "/rotor/mass is 1 in the first and 2.5 in the second");
  EXPECT_EQ(difference(plain, resolved(R"("sweep": "down")")),
            "/sweep is \"up\" in the first and \"down\" in the second");
  EXPECT_EQ(difference(plain, resolved(R"("validity": {"yield_strain": 0.002})")),
            "/validity/yield_strain is absent in the first and 0.002 in the second");
  EXPECT_EQ(difference(resolved(R"("unbalance": {})"), plain),
            "/grid/unbalance is [0] in the first and absent in the second");
  EXPECT_EQ(difference(plain, resolved_json(parse_scene(kShort))),
            "/grid/speed_ratio has 2 values in the first and 1 in the second");
  EXPECT_EQ(difference(plain, resolved_json(parse_scene(R"({"grid": {"speed_ratio": [0.5, 0.7]}})"))),
            "/grid/speed_ratio/1 is 0.6 in the first and 0.7 in the second");
}

}  // namespace
}  // namespace rubatlas::settings

// What the reader makes of a legal scene.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "settings/observable_names.hpp"
#include "settings/quantity.hpp"
#include "settings/reader.hpp"
#include "settings/scene_file.hpp"

namespace rubatlas::settings {
namespace {

Scene scene_with(const std::string& addition) {
  return parse_scene(R"({"grid": {"speed_ratio": 0.5})" + (addition.empty() ? "" : ", " + addition) + "}");
}

TEST(SceneReader, DefaultsAreThePapersDefaultRotor) {
  // MODEL 6.1 and 6
  const Scene scene = scene_with("");
  EXPECT_EQ(scene.ring.radius, 0.11);
  EXPECT_EQ(scene.blades.length, 0.1);
  EXPECT_EQ(scene.blades.hub_radius, 0.0);
  EXPECT_NEAR(scene.clearance(), 0.01, 1e-17);
  EXPECT_EQ(scene.rotor.mass, 1.0);
  EXPECT_EQ(scene.rotor.natural_frequency, 10.0);
  EXPECT_EQ(scene.rotor.damping_ratio, 0.1);
  EXPECT_EQ(scene.contact.friction, 0.1);
  EXPECT_EQ(scene.contact.law, ContactLaw::elastica);
  EXPECT_EQ(scene.blades.youngs_modulus, 206e9);
  EXPECT_EQ(scene.blades.width, 0.01);
  EXPECT_EQ(scene.blades.thickness, 0.001);
  EXPECT_EQ(scene.rotor.misalignment, 0.01001);
  EXPECT_FALSE(scene.unbalance.has_value());
  EXPECT_EQ(scene.blades.count, 3);
  EXPECT_EQ(scene.protocol.transient_revolutions, 200);
  EXPECT_EQ(scene.protocol.sampled_revolutions, 100);
  EXPECT_EQ(scene.sweep, Sweep::up);
  EXPECT_EQ(scene.initial.x, 0.0);
  EXPECT_EQ(scene.initial.vy, 0.0);
  EXPECT_EQ(scene.validity.max_shortening, 0.5);
  EXPECT_FALSE(scene.validity.yield_strain.has_value());
  EXPECT_EQ(scene.accuracy.method, Method::collocation);
  EXPECT_EQ(scene.accuracy.tolerance, 1e-9);
  EXPECT_EQ(scene.observables, (std::vector<std::string>{"poincare", "max_displacement", "spectrum"}));
}

TEST(SceneReader, EveryQuantityIsReadWhereItsPointerSays) {
  // Each quantity in turn gets a legal value that is not its default; reading it back must give that value.
  for (const auto& entry : quantities()) {
    if (entry.write == nullptr) continue;
    std::string value;
    const auto before = entry.read(Scene{});
    switch (entry.kind) {
      case Kind::text:
        value = "\"some text\"";
        break;
      case Kind::choice:
        value = "\"" + std::string(entry.choices.back()) + "\"";
        break;
      case Kind::numbers:
        value = "[0.0001, 0.0, -0.0002]";
        break;
      case Kind::flag:
        value = "true";
        break;
      case Kind::whole_number:
        value = "7";
        break;
      case Kind::number:
        // A ring that the blades fit into, spreads that leave something of each blade.
        value = entry.pointer == "/ring/radius"        ? "0.5"
                : entry.section() == "/unequal_blades" ? "0.0000152587890625"
                : entry.section() == "/stick"          ? "2.5"
                                                       : "0.0078125";
        break;
    }
    nlohmann::json document = {{"grid", {{"speed_ratio", 0.5}}}};
    document[nlohmann::json::json_pointer(std::string(entry.pointer))] = nlohmann::json::parse(value);
    // A quantity that only some words of a choice read needs one of them.
    if (!entry.chooser.empty())
      document[nlohmann::json::json_pointer(std::string(entry.chooser))] = entry.readers.front();
    // A damper needs a ring that yields.
    if (entry.section() == "/contact_damping") document["contact"]["law"] = "elastic_ring";
    const Scene scene = parse_scene(document.dump());
    const auto after = entry.read(scene);
    ASSERT_TRUE(after.has_value()) << entry.pointer;
    EXPECT_NE(before, after) << entry.pointer;
    if (entry.kind == Kind::number) {
      EXPECT_EQ(std::get<double>(*after), std::stod(value)) << entry.pointer;
    } else if (entry.kind == Kind::whole_number) {
      EXPECT_EQ(std::get<int>(*after), 7) << entry.pointer;
    }
  }
}

TEST(SceneReader, EveryDefaultIsInItsRange) {
  for (const auto& entry : quantities()) {
    if (entry.read == nullptr) continue;
    const auto value = entry.read(Scene{});
    if (!value) continue;
    if (const auto* number = std::get_if<double>(&*value)) {
      EXPECT_TRUE(entry.range.contains(*number)) << entry.pointer;
    } else if (const auto* whole_number = std::get_if<int>(&*value)) {
      EXPECT_TRUE(entry.range.contains(*whole_number)) << entry.pointer;
    }
  }
}

TEST(SceneReader, TheTableCallsEveryQuantityByMeaningUnitAndAnAsciiPhrase) {
  for (const auto& entry : quantities()) {
    EXPECT_FALSE(entry.meaning.empty()) << entry.pointer;
    EXPECT_TRUE(std::all_of(entry.meaning.begin(), entry.meaning.end(), [](char letter) {
      return letter > 0;
    })) << entry.pointer;
    const bool is_number =
        entry.kind == Kind::number || entry.kind == Kind::whole_number || entry.kind == Kind::numbers;
    EXPECT_EQ(is_number, !entry.unit.empty()) << entry.pointer;
    EXPECT_EQ(&quantity(entry.pointer), &entry);
  }
  EXPECT_THROW(static_cast<void>(quantity("/no/such")), std::out_of_range);
}

TEST(SceneReader, ARangeIsEvenlySpacedAndEndsExactly) {
  const Scene scene = parse_scene(R"({"grid": {"speed_ratio": {"from": 0.05, "to": 0.95, "count": 1000}}})");
  const auto& speeds = scene.grid.speed_ratio;
  ASSERT_EQ(speeds.size(), 1000U);
  EXPECT_EQ(speeds.front(), 0.05);
  EXPECT_EQ(speeds.back(), 0.95);
  for (int i = 0; i < 999; ++i) {
    EXPECT_DOUBLE_EQ(speeds[static_cast<std::size_t>(i)], 0.05 + i * (0.95 - 0.05) / 999);
  }
}

TEST(SceneReader, ValuesOfARangeAreTheNumbersThatAUserWouldWrite) {
  const Scene scene = parse_scene(R"({"grid": {"speed_ratio": {"from": 0.05, "to": 0.95, "count": 901},
    "damping_ratio": {"from": 0.05, "to": 0.3, "count": 6},
    "unbalance": {"from": 1e-6, "to": 1e-4, "count": 100}}})");
  EXPECT_EQ(scene.grid.damping_ratio, (std::vector{0.05, 0.1, 0.15, 0.2, 0.25, 0.3}));
  ASSERT_EQ(scene.grid.speed_ratio.size(), 901U);
  for (int i = 0; i < 901; ++i) {
    EXPECT_EQ(scene.grid.speed_ratio[static_cast<std::size_t>(i)], std::stod(fmt::format("{}e-3", 50 + i)));
  }
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(scene.grid.unbalance[static_cast<std::size_t>(i)], std::stod(fmt::format("{}e-6", 1 + i)));
  }
}

TEST(SceneReader, AxesThatAreNotNamedHoldTheScenesValue) {
  const Scene scene = scene_with(R"("rotor": {"damping_ratio": 0.2}, "blades": {"thickness": 0.002},
                                    "unbalance": {"moment": 1e-5})");
  EXPECT_EQ(scene.grid.damping_ratio, std::vector<double>{0.2});
  EXPECT_EQ(scene.grid.thickness, std::vector<double>{0.002});
  EXPECT_EQ(scene.grid.friction, std::vector<double>{0.1});
  EXPECT_EQ(scene.grid.unbalance, std::vector<double>{1e-5});
}

TEST(SceneReader, AnAxisOfOneValueIsTheScenesValue) {
  const Scene scene =
      parse_scene(R"({"grid": {"speed_ratio": 0.5, "damping_ratio": [0.3], "friction": 0.4}})");
  EXPECT_EQ(scene.rotor.damping_ratio, 0.3);
  EXPECT_EQ(scene.contact.friction, 0.4);
}

TEST(SceneReader, UnbalanceIsPresentWithItsSectionOrItsAxisOnly) {
  EXPECT_FALSE(scene_with("").unbalance.has_value());
  EXPECT_EQ(scene_with("").grid.unbalance, std::vector<double>{0.0});
  EXPECT_TRUE(scene_with(R"("unbalance": {})").unbalance.has_value());
  const Scene swept = parse_scene(R"({"grid": {"speed_ratio": 0.5, "unbalance": [0, 1e-5]}})");
  EXPECT_TRUE(swept.unbalance.has_value());
  EXPECT_EQ(swept.grid.unbalance, (std::vector<double>{0.0, 1e-5}));
}

TEST(SceneReader, TheSpectrumsHighestOrderFollowsBladesAndSamples) {
  EXPECT_EQ(scene_with("").spectrum.max_order, 12);
  EXPECT_EQ(scene_with(R"("blades": {"count": 5})").spectrum.max_order, 20);
  EXPECT_EQ(scene_with(R"("blades": {"count": 50})").spectrum.max_order, 128);  // half of 256 samples
  EXPECT_EQ(scene_with(R"("blades": {"count": 50}, "protocol": {"samples_per_revolution": 1024})")
                .spectrum.max_order,
            200);
  EXPECT_EQ(scene_with(R"("spectrum": {"max_order": 4})").spectrum.max_order, 4);
}

TEST(SceneReader, ObservablesAreKeptInTheOrderOfTheirList) {
  const Scene scene = scene_with(R"("observables": ["max_root_strain", "spectrum", "poincare"])");
  EXPECT_EQ(scene.observables, (std::vector<std::string>{"poincare", "spectrum", "max_root_strain"}));
  EXPECT_TRUE(scene_with(R"("observables": [])").observables.empty());
}

TEST(SceneReader, AClearanceOfRoundingIsZero) {
  const Scene scene = scene_with(R"("ring": {"radius": 0.3}, "blades": {"length": 0.2, "hub_radius": 0.1})");
  EXPECT_EQ(scene.clearance(), 0.0);
}

TEST(SceneReader, TheMarkWithWhichSomeEditorsBeginATextIsNotRead) {
  const std::filesystem::path path = ::testing::TempDir() + "marked.json";
  std::ofstream(path) << "\xEF\xBB\xBF{}";
  EXPECT_EQ(read_text(path), "{}");
  std::filesystem::remove(path);
}

TEST(SceneReader, EverySceneOfTheProjectIsLegal) {
  int count = 0;
  for (const auto& file : std::filesystem::directory_iterator(RUBATLAS_SOURCE_DIR "/jobs")) {
    if (file.path().extension() != ".json") continue;
    ++count;
    EXPECT_NO_THROW(parse_scene(read_text(file.path()), file.path().string())) << file.path();
  }
  EXPECT_GT(count, 0);
}

}  // namespace
}  // namespace rubatlas::settings

// The table of combinations against the reader and against itself: what is refused, and what a motion takes
// up.
#include "settings/combinations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "plan/grid.hpp"
#include "plan/scene_of_line.hpp"
#include "random_scene.hpp"
#include "settings/quantity.hpp"
#include "settings/reader.hpp"
#include "settings/scene_file.hpp"

namespace rubatlas::test {
namespace {

using effects::Effects;
using settings::Combination;
using settings::ContactLaw;
using settings::EffectSet;
using settings::MotionFamily;

/// The sections of a line whose effects act by their own word, and have friction where they need it.
std::vector<std::string_view> acting_sections(const settings::Scene& line) {
  std::vector<std::string_view> found;
  effects::for_each_effect([&]<auto Effect>() {
    constexpr std::string_view kSection = effects::Settings<Effect>::kDescription.section;
    const bool needs_friction = kSection == "/stick" || kSection == "/regularised_friction";
    if (effects::acts<Effect>(line) && (line.contact.friction > 0.0 || !needs_friction)) {
      found.push_back(kSection);
    }
  });
  return found;
}

void expect_consumes_what_acts(const settings::Scene& scene) {
  const plan::Grid grid(scene);
  for (const std::size_t line : {std::size_t{0}, grid.line_count() - 1}) {
    const auto own = plan::scene_of_line(scene, grid.parameters(grid.point(line, 0)));
    EXPECT_EQ(settings::combination_of(own).consumed.sections(), acting_sections(own)) << "line " << line;
  }
}

TEST(Combinations, AMotionConsumesTheEffectsThatActInEveryShippedScene) {
  int scenes = 0;
  for (const auto& file : std::filesystem::directory_iterator(RUBATLAS_SOURCE_DIR "/jobs")) {
    if (file.path().extension() != ".json") continue;
    SCOPED_TRACE(file.path());
    expect_consumes_what_acts(settings::parse_scene(settings::read_text(file.path().string())));
    ++scenes;
  }
  EXPECT_GT(scenes, 40);
}

TEST(Combinations, AMotionConsumesTheEffectsThatActInRandomScenes) {
  int with_several = 0;
  for (std::uint64_t index = 0; index < 600; ++index) {
    SCOPED_TRACE(index);
    const settings::Scene scene = random_scene(index);
    expect_consumes_what_acts(scene);
    with_several += acting_sections(scene).size() > 2 ? 1 : 0;
  }
  EXPECT_GT(with_several, 50);
}

/// The default rotor without effects.
settings::Scene plain(ContactLaw law) {
  settings::Scene scene;
  scene.contact.law = law;
  scene.grid = {
      {scene.blades.thickness}, {0.0}, {scene.contact.friction}, {scene.rotor.damping_ratio}, {0.5}};
  return scene;
}

/// Switches an effect on: as its section is by default, or else with one of its numbers not zero.
template <auto Effect>
void switch_on(settings::Scene& scene) {
  (scene.*Effect).emplace();
  for (const auto& entry : settings::quantities()) {
    if (effects::acts<Effect>(scene)) return;
    const bool own = entry.section() == effects::Settings<Effect>::kDescription.section;
    if (own && entry.kind == settings::Kind::number) entry.write(scene, 1e-3);
  }
  ASSERT_TRUE(effects::acts<Effect>(scene));
}

/// With every effect switched on.
settings::Scene with_all_effects(settings::Scene scene) {
  effects::for_each_effect([&]<auto Effect>() { switch_on<Effect>(scene); });
  return scene;
}

/// Every set of effects, as the bits of a number; they are as they are in `all`.
void take_effects(const settings::Scene& all, std::uint32_t bits, settings::Scene& scene) {
  effects::for_each_effect([&]<auto Effect>() {
    if ((bits & 1U) != 0) scene.*Effect = all.*Effect;
    bits >>= 1U;
  });
}

int effect_count() {
  int count = 0;
  effects::for_each_effect([&]<auto Effect>() { ++count; });
  return count;
}

bool has_a_family(const settings::Scene& scene) {
  return std::ranges::any_of(settings::families(),
                             [&](const settings::Family& family) { return family.takes(scene); });
}

TEST(Combinations, EverySetOfEffectsIsRefusedIfAndOnlyIfNoFamilyOfMotionsTakesIt) {
  std::uint32_t accepted = 0;
  std::uint32_t refused = 0;
  for (const ContactLaw law : {ContactLaw::elastica, ContactLaw::elastic_ring, ContactLaw::beam_column}) {
    const settings::Scene without = plain(law);
    const settings::Scene all = with_all_effects(without);
    for (std::uint32_t bits = 0; bits < std::uint32_t{1} << static_cast<unsigned>(effect_count()); ++bits) {
      settings::Scene scene = without;
      take_effects(all, bits, scene);
      for (const double ring_mass : {1.0, 0.0}) {
        if (ring_mass == 0.0 && !scene.ring_body) continue;
        if (scene.ring_body) scene.ring_body->mass = ring_mass;
        const auto refusal = settings::refusal_of_combination(scene);
        ASSERT_NE(refusal.has_value(), has_a_family(scene))
            << refusal.value_or("no family") << "; law " << static_cast<int>(law) << ", effects " << bits;
        ++(refusal ? refused : accepted);
      }
    }
  }
  EXPECT_GT(accepted, 1000U);
  EXPECT_GT(refused, 1000U);
}

TEST(Combinations, TheOtherMethodsHaveAFamilyForTheUnbalanceOnly) {
  using settings::Method;
  for (const Method method :
       {Method::hybrid_54, Method::hybrid_32, Method::paper, Method::located, Method::fixed}) {
    for (const ContactLaw law : {ContactLaw::elastica, ContactLaw::elastic_ring, ContactLaw::beam_column}) {
      settings::Scene scene = plain(law);
      scene.accuracy.method = method;
      int taken = 0;
      effects::for_each_effect([&]<auto Effect>() {
        settings::Scene with = scene;
        switch_on<Effect>(with);
        EXPECT_NE(settings::refusal_of_combination(with).has_value(), has_a_family(with));
        taken += has_a_family(with) ? 1 : 0;
      });
      EXPECT_EQ(taken, 1) << "the unbalance";
      EXPECT_TRUE(has_a_family(scene));
    }
  }
}

TEST(Combinations, ARingWithoutMassTakesNoDamping) {
  settings::Scene scene = plain(ContactLaw::elastic_ring);
  scene.ring_body = effects::RingBody{.mass = 0.0, .compliance = 1e-4, .damping = 0.0};
  EXPECT_EQ(settings::combination_of(scene).family->kind, MotionFamily::blades_in_ring_without_mass);
  scene.ring_body->damping = 1.0;
  EXPECT_TRUE(settings::refusal_of_combination(scene).has_value());
  EXPECT_FALSE(has_a_family(scene));
}

TEST(Combinations, ALineIsComputedByTheFirstFamilyThatTakesItsEffects) {
  const auto family = [](ContactLaw law, auto change) {
    settings::Scene scene = plain(law);
    change(scene);
    return settings::combination_of(scene).family->kind;
  };
  const auto nothing = [](settings::Scene&) {};
  const auto gravity = [](settings::Scene& scene) { scene.gravity.emplace(); };
  const auto weightless = [](settings::Scene& scene) { scene.gravity.emplace().acceleration = 0.0; };
  const auto unbalance = [](settings::Scene& scene) { scene.unbalance.emplace().moment = 1e-4; };
  const auto stick = [](settings::Scene& scene) { scene.stick.emplace(); };
  const auto release = [](settings::Scene& scene) { scene.release.emplace(); };
  const auto load = [](settings::Scene& scene) { scene.load_direction.emplace(); };
  const auto ring = [](settings::Scene& scene) { scene.ring_body.emplace(); };
  EXPECT_EQ(family(ContactLaw::elastica, nothing), MotionFamily::paper_s_rotor);
  EXPECT_EQ(family(ContactLaw::beam_column, unbalance), MotionFamily::paper_s_rotor);
  EXPECT_EQ(family(ContactLaw::elastic_ring, weightless), MotionFamily::paper_s_rotor);
  EXPECT_EQ(family(ContactLaw::elastic_ring, gravity), MotionFamily::rigid_blades);
  EXPECT_EQ(family(ContactLaw::elastica, gravity), MotionFamily::elastic_blades);
  EXPECT_EQ(family(ContactLaw::elastic_ring, stick), MotionFamily::sticking_rigid_blades);
  EXPECT_EQ(family(ContactLaw::elastica, stick), MotionFamily::sticking_elastic_blades);
  EXPECT_EQ(family(ContactLaw::beam_column, release), MotionFamily::elastic_blades);
  EXPECT_EQ(family(ContactLaw::elastica, load), MotionFamily::directed_elastic_blades);
  EXPECT_EQ(family(ContactLaw::elastica, ring), MotionFamily::blades_in_ring_body);
}

TEST(Combinations, LinesOfAGridHaveTheirOwn) {
  const auto scene = settings::parse_scene(R"({"grid": {"speed_ratio": 0.5, "friction": [0, 0.1, 0.2],
    "/support/stiffness_xx": [-1, 0, 1], "/side_load/force": [0, 0.1]}, "stick": {}})");
  const auto found = settings::combinations_in(scene);
  // Each line by itself, for comparison.
  const plan::Grid grid(scene);
  std::vector<Combination> expected;
  for (std::size_t line = 0; line < grid.line_count(); ++line) {
    const auto one =
        settings::combination_of(plan::scene_of_line(scene, grid.parameters(grid.point(line, 0))));
    if (std::ranges::find(expected, one) == expected.end()) expected.push_back(one);
  }
  EXPECT_EQ(expected.size(), 8U) << "with and without each of stick, support and side load";
  EXPECT_TRUE(std::ranges::is_permutation(found, expected));
}

TEST(Combinations, ASetNamesItsSectionsInTheOrderOfTheList) {
  EffectSet set = settings::effect_set<&Effects::wear, &Effects::gravity>();
  EXPECT_EQ(set.sections(), (std::vector<std::string_view>{"/gravity", "/wear"}));
  EXPECT_TRUE(set.contains<&Effects::wear>());
  EXPECT_FALSE(set.contains<&Effects::stick>());
  set.insert<&Effects::stick>();
  EXPECT_FALSE(set.is_within(settings::effect_set<&Effects::wear, &Effects::gravity>()));
  EXPECT_EQ(set - settings::effect_set<&Effects::wear>(),
            (settings::effect_set<&Effects::stick, &Effects::gravity>()));
}

}  // namespace
}  // namespace rubatlas::test

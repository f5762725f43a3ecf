// Every effect of the list in motion, on its scene of jobs/. Nothing here names one.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "effect_scene.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;
using nlohmann::json;

constexpr double kSpeeds[] = {0.3, 0.45, 0.62};
constexpr int kRevolutions = 4;

/// The effect's section at zero strength: as it is by default, or with one of its numbers at zero, or with
/// one of its flags down.
std::optional<json> zero_strength(const effects::Listed& effect) {
  settings::Scene scene;
  effect.add(scene);
  if (!effect.acts(scene)) return json::object();
  for (const settings::Quantity* entry : quantities_of(effect.description.section)) {
    const bool number = entry->kind == settings::Kind::number && entry->range.contains(0.0);
    if (!number && entry->kind != settings::Kind::flag) continue;
    effect.add(scene);
    entry->write(scene, number ? settings::Value{0.0} : settings::Value{false});
    if (effect.acts(scene)) continue;
    return json{{std::string(entry->key()), number ? json(0.0) : json(false)}};
  }
  return std::nullopt;
}

TEST(EveryEffect, ActsInItsSceneAndChangesTheMotion) {
  for (const effects::Listed& effect : effects::listed()) {
    SCOPED_TRACE(name_of(effect));
    double largest = 0.0;
    for (const double speed : kSpeeds) {
      const json with = effect_scene(name_of(effect), speed, kRevolutions);
      const settings::Scene scene = parsed(with);
      EXPECT_TRUE(effect.acts(scene));
      const auto outcome = run(scene);
      const auto plain = run(parsed(without(effect, with)));
      EXPECT_EQ(outcome.status, PointStatus::done) << speed;
      EXPECT_EQ(plain.status, PointStatus::done) << speed;
      EXPECT_GT(outcome.work.touchdowns, 0U) << speed;
      largest = std::max(largest, largest_difference(outcome.final_state, plain.final_state));
    }
    EXPECT_GT(largest, 1e-8) << "m: the motion is that without the effect";
  }
}

TEST(EveryEffect, OfZeroStrengthIsAsIfItWereAbsent) {
  for (const effects::Listed& effect : effects::listed()) {
    SCOPED_TRACE(name_of(effect));
    const auto zero = zero_strength(effect);
    ASSERT_TRUE(zero.has_value()) << "none of its numbers at zero switches it off";
    for (const double speed : kSpeeds) {
      json scene = without(effect, effect_scene(name_of(effect), speed, kRevolutions));
      const auto absent = run(parsed(scene));
      scene[json::json_pointer(std::string(effect.description.section))] = *zero;
      const auto present = run(parsed(scene));
      ASSERT_EQ(absent.status, PointStatus::done);
      EXPECT_EQ(present.rows, absent.rows) << "to the last bit";
      EXPECT_EQ(present.final_state, absent.final_state);
      EXPECT_EQ(present.work.right_hand_sides, absent.work.right_hand_sides);
    }
  }
}

TEST(EveryEffect, ConvergesAsTheToleranceTightens) {
  for (const effects::Listed& effect : effects::listed()) {
    for (const double speed : kSpeeds) {
      json scene = effect_scene(name_of(effect), speed, kRevolutions);
      const double scale = growth_of_errors(parsed(scene)) * parsed(scene).clearance();
      const auto end = [&](double tolerance) {
        scene["accuracy"]["tolerance"] = tolerance;
        const auto outcome = run(parsed(scene));
        EXPECT_EQ(outcome.status, PointStatus::done)
            << name_of(effect) << ", speed " << speed << ", tolerance " << tolerance;
        return outcome.final_state;
      };
      const auto best = end(1e-13);
      for (const double tolerance : {1e-5, 1e-7, 1e-9, 1e-11}) {
        EXPECT_LE(largest_difference(end(tolerance), best), 100.0 * tolerance * scale)
            << name_of(effect) << ", speed " << speed << ", tolerance " << tolerance;
      }
    }
  }
}

/// Whether a motion can go on from its state, whatever led to it.
bool state_is_all(const effects::Listed& effect) {
  return effect.description.breaks.find("a state alone") == std::string_view::npos;
}

TEST(EveryEffect, BreaksTheSymmetryOfBladePassingsIfAndOnlyIfItSaysSo) {
  for (const effects::Listed& effect : effects::listed()) {
    if (!state_is_all(effect)) continue;
    json scene = effect_scene(name_of(effect), 0.45, kRevolutions);
    scene["observables"] = std::vector{"poincare_blade_passing"};
    scene["accuracy"]["tolerance"] = 1e-12;
    const settings::Scene checked = parsed(scene);
    const auto motion = run(checked, {1e-3, 0.0, 0.0, 1e-3});
    ASSERT_EQ(motion.status, PointStatus::done);
    const auto& passings = motion.rows[0];
    const auto later = run(checked, {passings[0], passings[1], passings[2], passings[3]});
    const double departure = largest_difference(later.rows[0], passings, 0, 4);
    const bool says_so = effect.description.breaks.find("blade passing") != std::string_view::npos;
    EXPECT_EQ(departure > 1e-6, says_so) << name_of(effect) << ": departs by " << departure << " m";
    if (!says_so) {
      EXPECT_LE(departure, 1e-9) << name_of(effect);
    }
  }
}

TEST(EveryEffect, IsTheSameMotionWhereverItsLineResumes) {
  for (const effects::Listed& effect : effects::listed()) {
    if (!state_is_all(effect)) continue;
    SCOPED_TRACE(name_of(effect));
    const auto whole = run(parsed(effect_scene(name_of(effect), 0.45, 4)));
    const settings::Scene half = parsed(effect_scene(name_of(effect), 0.45, 2));
    const auto second = run(half, run(half).final_state);
    const double scale = growth_of_errors(half) * half.clearance();
    EXPECT_LE(largest_difference(second.final_state, whole.final_state), 100.0 * 1e-9 * scale);
  }
}

}  // namespace
}  // namespace rubatlas::test

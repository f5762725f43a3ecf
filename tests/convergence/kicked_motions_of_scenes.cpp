/// Error follows tolerance under every law of contact and every effect that a scene may call for, from random
/// kicked starts: contacts that end on the receding side, several at once, slip that reverses, tips that
/// rest.
///
/// One revolution each, against the same motion at a far lower tolerance. A tolerance bounds the error of a
/// step; what the motion makes of an error is its own, and measured from starts a little aside.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "../effects/effect_scene.hpp"

namespace rubatlas::test {
namespace {

using Json = nlohmann::json;
using ending::PointStatus;
using ending::StatusDetail;
using motion::SectionState;
using point::PointOutcome;

struct NamedScene {
  std::string name;
  Json scene;
};

Json with(Json scene, const Json& more) {
  scene.merge_patch(more);
  return scene;
}

/// Both laws, every effect in its own scene, and the combinations that have a right-hand side of their own.
std::vector<NamedScene> all_scenes() {
  const Json plain = {{"grid", {{"speed_ratio", 0.5}}}};
  const Json rigid = with(plain, {{"contact", {{"law", "elastic_ring"}}}});
  const Json ten = with(plain, {{"blades", {{"count", 10}}}});
  const Json normal_load = {{"load_direction", {{"along_normal", true}}}};
  const Json steep = {{"regularised_friction", {{"velocity", 0.01}}}};
  const Json stribeck = {{"stribeck", effect_scene("stribeck", 0.5, 1).at("stribeck")}};
  const Json ring_body = {{"ring_body", {{"mass", 1.0}, {"compliance", 1e-4}, {"damping", 40.0}}}};
  const Json stick = {{"contact", {{"friction", 0.5}}}, {"stick", Json::object()}};
  std::vector<NamedScene> scenes = {{"elastica", plain}, {"elastic_ring", rigid}};
  for (const effects::Listed& effect : effects::listed()) {
    scenes.push_back({name_of(effect), effect_scene(name_of(effect), 0.5, 1)});
  }
  scenes.push_back({"ten_blades", ten});
  scenes.push_back({"ten_blades_under_the_normal_load", with(ten, normal_load)});
  scenes.push_back({"steep_friction", with(plain, steep)});
  scenes.push_back({"steep_friction_under_the_normal_load", with(with(plain, normal_load), steep)});
  scenes.push_back({"stribeck_under_the_normal_load", with(with(plain, normal_load), stribeck)});
  scenes.push_back({"steep_friction_of_rigid_blades", with(rigid, steep)});
  scenes.push_back({"stribeck_of_rigid_blades", with(rigid, stribeck)});
  scenes.push_back({"rigid_blades_in_a_ring_body", with(rigid, ring_body)});
  scenes.push_back({"elastic_blades_that_stick", with(plain, stick)});
  const Json collocation = {{"accuracy", {{"method", "collocation"}}}};
  scenes.push_back({"elastica_by_collocation", with(plain, collocation)});
  scenes.push_back({"ten_blades_by_collocation", with(ten, collocation)});
  scenes.push_back(
      {"unbalance_by_collocation", with(with(plain, {{"unbalance", {{"moment", 1e-4}}}}), collocation)});
  return scenes;
}

struct Kick {
  double speed_ratio;
  SectionState start;
};

std::vector<Kick> kicks() {
  constexpr int kMotions = 6;
  std::mt19937_64 generator(7);
  const auto between = [&](double least, double most) {
    return least + (most - least) * static_cast<double>(generator() >> 11U) * 0x1p-53;
  };
  std::vector<Kick> result;
  for (int i = 0; i < kMotions; ++i) {
    Kick kick{};
    kick.speed_ratio = between(0.2, 0.8);
    for (std::size_t k = 0; k < 4; ++k) {
      const double most = k < 2 ? 0.004 : 0.04;  // [m], [m per unit τ]
      kick.start[k] = between(-most, most);
    }
    result.push_back(kick);
  }
  return result;
}

class KickedMotionOfScene : public ::testing::TestWithParam<NamedScene> {};

TEST_P(KickedMotionOfScene, ErrsByItsToleranceTimesItsOwnGrowthOfErrors) {
  constexpr double kMost = 200.0;  // tolerances; the largest of all is 110
  constexpr double kAside = 1e-9;  // [m], [m per unit τ]
  Json scene = GetParam().scene;
  scene.erase("initial");
  scene["protocol"] = {{"transient_revolutions", 0}, {"sampled_revolutions", 1}};
  scene["observables"] = {"poincare"};
  const auto end_of = [&](double tolerance, const SectionState& start) {
    scene["accuracy"]["tolerance"] = tolerance;
    return run(parsed(scene), start);
  };
  const auto met_its_bound = [](const PointOutcome& outcome) {
    return outcome.detail == StatusDetail::event_work || outcome.detail == StatusDetail::contact_work;
  };
  int compared = 0;
  for (const Kick& kick : kicks()) {
    scene["grid"]["speed_ratio"] = kick.speed_ratio;
    const PointOutcome reference = end_of(1e-12, kick.start);
    if (met_its_bound(reference)) continue;
    double growth = 1.0;
    bool predictable = true;
    for (std::size_t i = 0; i < 2 * kick.start.size(); ++i) {
      // A motion that is done shows by its growth how far it is predictable; of one that ended, neighbours on
      // either side tell. (Ten blades with 400 touch-downs in a revolution: a change by 1e-15 decides whether
      // a blade meets its limit.)
      if (i >= kick.start.size() && reference.status == PointStatus::done) break;
      SectionState aside = kick.start;
      aside[i % kick.start.size()] += i < kick.start.size() ? kAside : -kAside;
      const PointOutcome other = end_of(1e-12, aside);
      predictable = predictable && other.status == reference.status;
      if (other.status != PointStatus::done || reference.status != PointStatus::done) continue;
      growth = std::max(growth, largest_difference(other.final_state, reference.final_state) / kAside);
    }
    if (!predictable) continue;
    for (const double tolerance : {1e-7, 1e-9, 1e-11}) {
      SCOPED_TRACE(::testing::Message() << "speed ratio " << kick.speed_ratio << ", tolerance " << tolerance
                                        << ", growth " << growth);
      const PointOutcome motion = end_of(tolerance, kick.start);
      EXPECT_EQ(motion.status, reference.status) << ending::text_of(motion.detail);
      if (motion.status != PointStatus::done || reference.status != PointStatus::done) continue;
      EXPECT_LE(largest_difference(motion.final_state, reference.final_state),
                kMost * tolerance * parsed(scene).clearance() * growth);
      ++compared;
    }
  }
  EXPECT_GE(compared, 9) << "half of the motions leave validity";
}

INSTANTIATE_TEST_SUITE_P(EveryLawAndEffect, KickedMotionOfScene, ::testing::ValuesIn(all_scenes()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace rubatlas::test

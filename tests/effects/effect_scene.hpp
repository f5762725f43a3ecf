/// What the tests that go through the list of effects have in common: the scene of `jobs/` that shows an
/// effect, with and without it, and a point of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../support/point.hpp"
#include "settings/quantity.hpp"
#include "settings/reader.hpp"
#include "settings/scene_file.hpp"

namespace rubatlas::test {

/// "speed_ripple" for the section "/speed_ripple".
inline std::string name_of(const effects::Listed& effect) {
  return settings::axis_name(effect.description.section);
}

/// Quantities of a section, in the reader's table.
inline std::vector<const settings::Quantity*> quantities_of(std::string_view section) {
  std::vector<const settings::Quantity*> found;
  for (const auto& entry : settings::quantities()) {
    if (entry.section() == section) found.push_back(&entry);
  }
  return found;
}

/// `jobs/effect_<name>.json`, shortened to a few revolutions at one speed ratio. Throws SceneError where
/// there is no such scene.
inline nlohmann::json effect_scene(const std::string& name, double speed_ratio, int revolutions) {
  auto scene = nlohmann::json::parse(
      settings::read_text(std::string(RUBATLAS_SOURCE_DIR "/jobs/effect_") + name + ".json"));
  scene["grid"]["speed_ratio"] = speed_ratio;
  scene["protocol"] = {{"transient_revolutions", 0}, {"sampled_revolutions", revolutions}};
  scene["observables"] = {"poincare", "max_displacement", "max_contact_force"};
  return scene;
}

/// The same scene without the effect's section.
inline nlohmann::json without(const effects::Listed& effect, nlohmann::json scene) {
  const nlohmann::json::json_pointer section{std::string(effect.description.section)};
  scene.at(section.parent_pointer()).erase(section.back());
  return scene;
}

inline settings::Scene parsed(const nlohmann::json& scene) {
  return settings::parse_scene(scene.dump());
}

/// Largest difference of two rows, from an entry of either on.
inline double largest_difference(const std::vector<double>& a, const std::vector<double>& b,
                                 std::size_t from_a = 0, std::size_t from_b = 0) {
  double largest = 0.0;
  for (; from_a < a.size() && from_b < b.size(); ++from_a, ++from_b) {
    largest = std::max(largest, std::abs(a[from_a] - b[from_b]));
  }
  return largest;
}

/// By how much an error made at the start is larger at the end, from starts a little aside; 1 where errors
/// shrink. What a tolerance bounds is the error of a step: the rest is the motion's own.
inline double growth_of_errors(const settings::Scene& scene) {
  const double shift = 1e-6 * scene.clearance();
  const auto end = run(scene).final_state;
  double growth = 1.0;
  for (std::size_t i = 0; i < end.size(); ++i) {
    motion::SectionState start{};
    start[i] = shift;
    growth = std::max(growth, largest_difference(run(scene, start).final_state, end) / shift);
  }
  return growth;
}

}  // namespace rubatlas::test

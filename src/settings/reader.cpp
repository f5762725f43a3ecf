#include "settings/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "settings/axes.hpp"
#include "settings/document.hpp"
#include "settings/keys.hpp"
#include "settings/nearest.hpp"
#include "settings/observable_names.hpp"
#include "settings/quantity.hpp"
#include "settings/scene_checks.hpp"
#include "settings/values.hpp"

namespace rubatlas::settings {
namespace {

using nlohmann::json;

void read_values(const json& document, Scene& scene) {
  for (const auto& section : sections()) {
    const auto found = document.find(last_key(section.pointer));
    if (section.open != nullptr && found != document.end() && !found->is_null()) section.open(scene);
  }
  for (const auto& entry : quantities()) {
    const json::json_pointer pointer{std::string(entry.pointer)};
    if (entry.write == nullptr || !document.contains(pointer)) continue;
    entry.write(scene, checked_value(document.at(pointer), entry.pointer, entry));
  }
}

void read_observables(const json& document, Scene& scene) {
  const auto known = observable_names();
  const auto found = document.find("observables");
  if (found == document.end()) {
    const auto names = default_observable_names();
    scene.observables.assign(names.begin(), names.end());
    return;
  }
  if (!found->is_array()) {
    fail("/observables", fmt::format("{} is not a list of {}", shown(*found), quoted(known)));
  }
  std::vector<std::string> asked;
  for (std::size_t i = 0; i < found->size(); ++i) {
    const auto& value = (*found)[i];
    const auto here = child("/observables", std::to_string(i));
    if (!value.is_string()) fail(here, fmt::format("{} is not one of {}", shown(value), quoted(known)));
    auto name = value.get<std::string>();
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      fail(here, fmt::format("{} is not one of {}; nearest: \"{}\"", shown(value), quoted(known),
                             nearest(name, known)));
    }
    if (std::find(asked.begin(), asked.end(), name) != asked.end()) {
      fail(here, fmt::format("{} stands twice; once is allowed", shown(value)));
    }
    asked.push_back(std::move(name));
  }
  for (const auto name : known) {
    if (std::find(asked.begin(), asked.end(), name) != asked.end()) scene.observables.emplace_back(name);
  }
}

}  // namespace

Scene parse_scene(std::string_view text, std::string_view name) {
  const json document = parse_document(text, name);
  check_structure(document);
  Scene scene;
  read_values(document, scene);
  read_grid(document, scene);
  read_observables(document, scene);
  check_together(document, scene);
  return scene;
}

}  // namespace rubatlas::settings

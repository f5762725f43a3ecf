// The canonical text of a scene, and the first difference between two such texts.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "settings/document.hpp"
#include "settings/quantity.hpp"
#include "settings/reader.hpp"
#include "settings/scene_checks.hpp"

namespace rubatlas::settings {
namespace {

using nlohmann::json;

/// Keys that name an atlas and say nothing of its motions.
constexpr std::array<std::string_view, 4> kNaming{"title", "reference", "creator", "license"};

json as_json(const Value& value) {
  return std::visit([](const auto& content) { return json(content); }, value);
}

// Objects have one key a line and lists stand on one line, so that a thousand speeds stay readable. The
// library sorts the keys.
void write(const json& value, const std::string& indent, std::string& text) {
  if (value.is_number_float()) {
    text += shortest(value.get<double>());
  } else if (value.is_array()) {
    text += '[';
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (i > 0) text += ", ";
      write(value[i], indent, text);
    }
    text += ']';
  } else if (value.is_object()) {
    text += '{';
    bool first = true;
    for (const auto& [key, member] : value.items()) {
      text += fmt::format("{}\n{}  {}: ", first ? "" : ",", indent, json(key).dump());
      write(member, indent + "  ", text);
      first = false;
    }
    text += first ? "}" : fmt::format("\n{}}}", indent);
  } else {
    text += value.dump();
  }
}

std::string first_difference(const json& a, const json& b, const std::string& pointer) {
  if (a.is_object() && b.is_object()) {
    auto keys = a;
    keys.update(b);
    for (const auto& [key, unused] : keys.items()) {
      const auto here = child(pointer, key);
      if (pointer.empty() && std::ranges::count(kNaming, key) > 0) continue;
      if (!b.contains(key))
        return fmt::format("{} is {} in the first and absent in the second", here, shown(a[key]));
      if (!a.contains(key))
        return fmt::format("{} is absent in the first and {} in the second", here, shown(b[key]));
      if (auto inside = first_difference(a[key], b[key], here); !inside.empty()) return inside;
    }
    return {};
  }
  if (a.is_array() && b.is_array()) {
    if (a.size() != b.size()) {
      return fmt::format("{} has {} values in the first and {} in the second", pointer, a.size(), b.size());
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (auto inside = first_difference(a[i], b[i], child(pointer, std::to_string(i))); !inside.empty())
        return inside;
    }
    return {};
  }
  if (a == b) return {};
  return fmt::format("{} is {} in the first and {} in the second", pointer, shown(a), shown(b));
}

json document_of(const Scene& scene) {
  json document;
  for (const auto& entry : quantities()) {
    if (entry.read == nullptr) continue;
    if (const auto value = entry.read(scene)) {
      document[json::json_pointer{std::string(entry.pointer)}] = as_json(*value);
    }
  }
  for (const auto& axis : grid_axes()) {
    const auto& entry = quantity(axis.quantity);
    // The axis of an absent effect is left out, because its name would switch the effect on.
    if (entry.read != nullptr && !entry.read(scene)) continue;
    document["grid"][std::string(axis.name)] = scene.grid.*axis.values;
  }
  for (const auto& swept : scene.grid.swept) document["grid"][swept.pointer] = swept.values;
  document["observables"] = scene.observables;
  if (!scene.pieces && is_cut_unasked(scene)) document["pieces"] = nullptr;
  return document;
}

std::string text_of(const json& document) {
  std::string text;
  write(document, "", text);
  return text + "\n";
}

}  // namespace

std::string resolved_json(const Scene& scene) {
  return text_of(document_of(scene));
}

std::string motion_json(const Scene& scene) {
  json document = document_of(scene);
  for (const auto key : kNaming) document.erase(std::string(key));
  return text_of(document);
}

std::string of_older_program(std::string_view resolved, bool knew_settle) {
  json document = parse_document(resolved, "scene");
  if (!document.contains("pieces")) document["pieces"] = nullptr;
  if (!knew_settle) {
    json& protocol = document["protocol"];
    protocol.erase("stop_when_periodic");
    protocol["settle"] = "never";
  }
  return resolved_json(parse_scene(document.dump(), "scene"));
}

std::string difference(std::string_view resolved_a, std::string_view resolved_b) {
  return first_difference(parse_document(resolved_a, "first"), parse_document(resolved_b, "second"), "");
}

}  // namespace rubatlas::settings

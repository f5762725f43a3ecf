#include "settings/keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "settings/document.hpp"
#include "settings/nearest.hpp"
#include "settings/quantity.hpp"
#include "settings/symbol.hpp"

namespace rubatlas::settings {
namespace {

using nlohmann::json;

/// Keys that may stand directly under a section (empty pointer: under the scene).
std::vector<std::string_view> known_keys(std::string_view section) {
  std::vector<std::string_view> keys;
  if (section == "/grid") {
    for (const auto& axis : grid_axes()) keys.push_back(axis.name);
    return keys;
  }
  for (const auto& entry : quantities()) {
    if (entry.section() == section) keys.push_back(entry.key());
  }
  if (section.empty()) {
    for (const auto& entry : sections()) keys.emplace_back(last_key(entry.pointer));
    keys.emplace_back("observables");
  }
  return keys;
}

/// The key that may have been meant: what has replaced it, else the same key in another section, else the key
/// whose symbol this is, else the key of the section with the nearest spelling.
std::string what_was_meant(std::string_view section, std::string_view key) {
  if (section == "/protocol" && key == "stop_when_periodic")
    return "replaced by /protocol/settle, by whose \"newton\", the default, transients of periodic motions "
           "end";
  for (const auto& entry : quantities()) {
    if (entry.key() == key) return fmt::format("nearest known key: {}", entry.pointer);
  }
  if (auto symbol = meaning_of_symbol(key, section); !symbol.empty()) return symbol;
  const auto keys = known_keys(section);
  return fmt::format("nearest known key: {}", child(section, nearest(key, keys)));
}

/// A key of `grid` that is a JSON pointer must be the pointer of a quantity that can be swept.
void check_pointer_axis(const std::string& key, const json& value) {
  const auto here = child("/grid", key);
  std::vector<std::string_view> allowed;
  for (const auto* entry : sweepable_quantities()) allowed.push_back(entry->pointer);
  if (std::ranges::count(allowed, key) > 0) return;
  std::vector<std::string_view> near = allowed;
  for (const auto& axis : grid_axes()) {
    if (key == axis.quantity) {
      fail(here, fmt::format("the axis of this quantity has a name of its own: {}", axis.name));
    }
    near.push_back(axis.quantity);
  }
  auto meant = meaning_of_symbol(last_key(key), "/grid");
  if (meant.empty()) {
    const auto best = nearest(key, near);
    const auto named = std::ranges::find(grid_axes(), best, &GridAxis::quantity);
    meant = fmt::format("nearest: {}", named == grid_axes().end() ? best : named->name);
  }
  fail(here, fmt::format("no quantity that can be swept, with the value {}; by their pointers can be: {}; {}",
                         shown(value), fmt::join(allowed, ", "), meant));
}

void check_keys(const json& object, std::string_view section) {
  const auto keys = known_keys(section);
  for (const auto& [key, value] : object.items()) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    if (section == "/grid" && key.starts_with('/')) {
      check_pointer_axis(key, value);
      continue;
    }
    fail(child(section, key),
         fmt::format("unknown key, with the value {}; known {}: {}{}; {}", shown(value),
                     section.empty() ? "in a scene" : fmt::format("in {}", section), fmt::join(keys, ", "),
                     section == "/grid" ? ", and pointers of other quantities" : "",
                     what_was_meant(section, key)));
  }
}

}  // namespace

void check_structure(const nlohmann::json& document) {
  if (!document.is_object())
    fail("", fmt::format("{} is not a scene; a scene is a JSON object", shown(document)));
  check_keys(document, "");
  for (const auto& section : sections()) {
    const auto found = document.find(last_key(section.pointer));
    if (found == document.end() || (found->is_null() && section.may_be_null)) continue;
    if (!found->is_object()) {
      fail(section.pointer, fmt::format("{} is not a section in braces; {}", shown(*found), section.meaning));
    }
    check_keys(*found, section.pointer);
  }
}

}  // namespace rubatlas::settings

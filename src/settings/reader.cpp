#include "settings/reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "settings/document.hpp"
#include "settings/effect_checks.hpp"
#include "settings/evenly_spaced.hpp"
#include "settings/nearest.hpp"
#include "settings/observable_names.hpp"
#include "settings/quantity.hpp"
#include "settings/symbol.hpp"

namespace rubatlas::settings {
namespace {

using nlohmann::json;

constexpr std::size_t kMostAxisValues = 1'000'000;
constexpr double kMostPoints = 1e9;

[[noreturn]] void fail(std::string_view pointer, const std::string& text) {
  throw SceneError(in_short(fmt::format("{}: {}", pointer.empty() ? "/" : pointer, text)));
}

std::string quoted(std::span<const std::string_view> words) {
  return fmt::format("\"{}\"", fmt::join(words, "\", \""));
}

std::string_view last_key(std::string_view pointer) {
  return pointer.substr(pointer.rfind('/') + 1);
}

// --- keys
// -----------------------------------------------------------------------------------------------------

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

/// The key that may have been meant: the same key in another section, else the key whose symbol this is, else
/// the key of the section with the nearest spelling.
std::string what_was_meant(std::string_view section, std::string_view key) {
  for (const auto& entry : quantities()) {
    if (entry.key() == key) return fmt::format("nearest known key: {}", entry.pointer);
  }
  if (auto symbol = meaning_of_symbol(key, section); !symbol.empty()) return symbol;
  const auto keys = known_keys(section);
  return fmt::format("nearest known key: {}", child(section, nearest(key, keys)));
}

bool is_pointer(std::string_view key) {
  return key.starts_with('/');
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
      fail(here, fmt::format("with the value {}; the axis of this quantity has a name of its own: {}",
                             shown(value), axis.name));
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
    if (section == "/grid" && is_pointer(key)) {
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

void check_structure(const json& document) {
  if (!document.is_object())
    fail("", fmt::format("{} is not a scene; a scene is a JSON object", shown(document)));
  check_keys(document, "");
  for (const auto& section : sections()) {
    const auto found = document.find(last_key(section.pointer));
    if (found == document.end()) continue;
    if (!found->is_object()) {
      fail(section.pointer, fmt::format("{} is not a section in braces; {}", shown(*found), section.meaning));
    }
    check_keys(*found, section.pointer);
  }
}

// --- values
// ---------------------------------------------------------------------------------------------------

std::string with_unit(const Quantity& entry) {
  const bool bare = entry.unit.empty() || entry.unit == "1";
  return bare ? entry.range.text() : fmt::format("{} {}", entry.range.text(), entry.unit);
}

double checked_number(const json& value, std::string_view pointer, const Quantity& entry) {
  if (!value.is_number()) {
    fail(pointer, fmt::format("{} is not a number in {}; {}", shown(value), with_unit(entry), entry.meaning));
  }
  const double number = value.get<double>();
  if (!entry.range.contains(number)) {
    fail(pointer, fmt::format("{} is outside {}; {}", shown(value), with_unit(entry), entry.meaning));
  }
  return number + 0.0;  // makes −0 zero, so that equal scenes have equal canonical texts
}

std::vector<double> checked_numbers(const json& value, std::string_view pointer, const Quantity& entry) {
  if (!value.is_array()) {
    fail(pointer,
         fmt::format("{} is not a list of numbers in {}; {}", shown(value), with_unit(entry), entry.meaning));
  }
  std::vector<double> numbers;
  for (std::size_t i = 0; i < value.size(); ++i) {
    numbers.push_back(checked_number(value[i], child(pointer, std::to_string(i)), entry));
  }
  return numbers;
}

Value checked_value(const json& value, std::string_view pointer, const Quantity& entry) {
  switch (entry.kind) {
    case Kind::number:
      return checked_number(value, pointer, entry);
    case Kind::whole_number:
      if (!value.is_number() || value.get<double>() != std::trunc(value.get<double>())) {
        fail(pointer, fmt::format("{} is not a whole number in {}; {}", shown(value), with_unit(entry),
                                  entry.meaning));
      }
      return static_cast<int>(checked_number(value, pointer, entry));
    case Kind::flag:
      if (!value.is_boolean()) {
        fail(pointer, fmt::format("{} is not true or false; {}", shown(value), entry.meaning));
      }
      return value.get<bool>();
    case Kind::text:
      if (!value.is_string()) fail(pointer, fmt::format("{} is not a text; {}", shown(value), entry.meaning));
      return value.get<std::string>();
    case Kind::numbers:
      return checked_numbers(value, pointer, entry);
    case Kind::choice:
      break;
  }
  if (!value.is_string()) {
    fail(pointer, fmt::format("{} is not one of {}; {}", shown(value), quoted(entry.choices), entry.meaning));
  }
  auto word = value.get<std::string>();
  if (std::find(entry.choices.begin(), entry.choices.end(), word) == entry.choices.end()) {
    fail(pointer, fmt::format("{} is not one of {}; {}; nearest: \"{}\"", shown(value), quoted(entry.choices),
                              entry.meaning, nearest(word, entry.choices)));
  }
  return word;
}

void read_values(const json& document, Scene& scene) {
  for (const auto& section : sections()) {
    if (section.open != nullptr && document.contains(last_key(section.pointer))) section.open(scene);
  }
  for (const auto& entry : quantities()) {
    const json::json_pointer pointer{std::string(entry.pointer)};
    if (entry.write == nullptr || !document.contains(pointer)) continue;
    entry.write(scene, checked_value(document.at(pointer), entry.pointer, entry));
  }
}

// --- grid
// -----------------------------------------------------------------------------------------------------

std::vector<double> read_list(const json& list, std::string_view pointer, const Quantity& entry) {
  if (list.empty())
    fail(pointer, fmt::format("the list is empty; at least one value is needed; {}", entry.meaning));
  if (list.size() > kMostAxisValues) {
    fail(pointer, fmt::format("{} values; at most {} are allowed", list.size(), kMostAxisValues));
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto here = child(pointer, std::to_string(i));
    const double value = checked_number(list[i], here, entry);
    if (i > 0 && value == values.back()) {
      fail(here, fmt::format("{} stands twice; values are ascending without duplicates", shown(list[i])));
    }
    if (i > 0 && value < values.back()) {
      fail(here, fmt::format("{} comes after {}; values are ascending without duplicates", shown(list[i]),
                             shown(list[i - 1])));
    }
    values.push_back(value);
  }
  return values;
}

std::vector<double> read_span(const json& span, std::string_view pointer, const Quantity& entry) {
  static constexpr std::array<std::string_view, 3> kKeys{"from", "to", "count"};
  for (const auto& [key, value] : span.items()) {
    if (std::find(kKeys.begin(), kKeys.end(), key) != kKeys.end()) continue;
    fail(child(pointer, key),
         fmt::format("unknown key, with the value {}; known in {}: {}; nearest known key: {}", shown(value),
                     pointer, fmt::join(kKeys, ", "), child(pointer, nearest(key, kKeys))));
  }
  for (const auto key : kKeys) {
    if (!span.contains(key)) fail(child(pointer, key), "missing; a range of values is from, to and count");
  }
  const double from = checked_number(span["from"], child(pointer, "from"), entry);
  const double to = checked_number(span["to"], child(pointer, "to"), entry);
  static constexpr Quantity kCount{.meaning = "number of values from `from` to `to`, both included",
                                   .kind = Kind::whole_number,
                                   .range = {.low = 2, .high = kMostAxisValues}};
  const int count = std::get<int>(checked_value(span["count"], child(pointer, "count"), kCount));
  if (!(to > from)) {
    fail(child(pointer, "to"),
         fmt::format("{} is not above from, {}; values are ascending without duplicates", shown(span["to"]),
                     shown(span["from"])));
  }
  auto values = evenly_spaced(from, to, count);
  if (std::ranges::adjacent_find(values, std::ranges::greater_equal{}) != values.end()) {
    fail(child(pointer, "count"), fmt::format("{} values from {} to {} are closer than numbers can be", count,
                                              shown(span["from"]), shown(span["to"])));
  }
  return values;
}

std::vector<double> read_axis(const json& value, std::string_view pointer, const Quantity& entry) {
  if (value.is_array()) return read_list(value, pointer, entry);
  if (value.is_object()) return read_span(value, pointer, entry);
  if (value.is_number()) return {checked_number(value, pointer, entry)};
  fail(pointer, fmt::format(R"({} is not a number, a list of numbers or {{"from", "to", "count"}} in {}; {})",
                            shown(value), with_unit(entry), entry.meaning));
}

/// Axes that the grid names by pointers. No point reads the scene's own value of such a quantity. The scene
/// gets the first value of the axis, so that anything computed from the scene alone belongs to a point of the
/// atlas.
void read_pointer_axes(const json& grid, Scene& scene) {
  for (const auto& [key, value] : grid.items()) {
    if (!is_pointer(key)) continue;
    const auto& entry = quantity(key);
    scene.grid.swept.push_back({key, read_axis(value, child("/grid", key), entry)});
    entry.write(scene, scene.grid.swept.back().values.front());
  }
  std::ranges::sort(scene.grid.swept, {}, [](const PointerAxis& axis) { return axis_name(axis.pointer); });
}

void read_grid(const json& document, Scene& scene) {
  const json grid = document.value("grid", json::object());
  double points = scene.sweep == Sweep::both ? 2.0 : 1.0;
  read_pointer_axes(grid, scene);
  for (const auto& swept : scene.grid.swept) points *= static_cast<double>(swept.values.size());
  for (const auto& axis : grid_axes()) {
    const auto& entry = quantity(axis.quantity);
    auto& values = scene.grid.*axis.values;
    if (const auto found = grid.find(axis.name); found != grid.end()) {
      values = read_axis(*found, child("/grid", axis.name), entry);
      // A swept quantity is present, and an axis of one value is the scene's value.
      if (entry.write != nullptr) {
        const auto own = entry.read(scene);
        if (!own || values.size() == 1) entry.write(scene, values.front());
      }
    } else if (entry.read == nullptr) {
      fail(entry.pointer, fmt::format(R"(missing; a number, a list or {{"from", "to", "count"}} in {}; {})",
                                      with_unit(entry), entry.meaning));
    } else {
      const auto own = entry.read(scene);
      values = {own ? std::get<double>(*own) : 0.0};  // the strength of an absent effect is zero
    }
    points *= static_cast<double>(values.size());
  }
  if (points > kMostPoints)
    fail("/grid", fmt::format("{} points; at most {} are allowed", points, kMostPoints));
}

// --- what more than one quantity decides
// ------------------------------------------------------------------------

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

/// A quantity that is read only under some words of a choice is refused under the others, as a key and as a
/// grid axis.
void check_choosers(const json& document, const Scene& scene) {
  for (const auto& entry : quantities()) {
    if (entry.chooser.empty() || entry.read(scene)) continue;
    const auto on_the_grid = child("/grid", entry.pointer);
    for (const auto& place : {std::string(entry.pointer), on_the_grid}) {
      const json::json_pointer pointer{place};
      if (!document.contains(pointer)) continue;
      const Quantity& chooser = quantity(entry.chooser);
      fail(place, fmt::format(R"({} has no effect under the {} {} "{}"; only {} reads it)",
                              shown(document.at(pointer)), last_key(chooser.section()), chooser.key(),
                              std::get<std::string>(*chooser.read(scene)),
                              fmt::format("\"{}\"", fmt::join(entry.readers, "\" or \""))));
    }
  }
}

/// The smallest clearance on the grid: that of the smallest ring with the longest blades on the largest hub.
void check_clearance(const Scene& scene) {
  Scene tightest = scene;
  std::string place = "/ring/radius";
  for (const auto& swept : scene.grid.swept) {
    const bool ring = swept.pointer == "/ring/radius";
    if (!ring && swept.pointer != "/blades/length" && swept.pointer != "/blades/hub_radius") continue;
    quantity(swept.pointer).write(tightest, ring ? swept.values.front() : swept.values.back());
    place = child("/grid", swept.pointer);
  }
  if (tightest.clearance() >= 0.0) return;
  fail(place,
       fmt::format("{}{} is smaller than hub_radius + length = {} m; the blades must fit into the ring{}",
                   place == "/ring/radius" ? "" : "a ring of radius ", shortest(tightest.ring.radius),
                   shortest(tightest.blades.hub_radius + tightest.blades.length),
                   place == "/ring/radius" ? "" : " at every point of the grid"));
}

/// All samples of a spectrum are transformed at once, so their number is limited.
void check_spectrum(const Scene& scene) {
  if (std::ranges::count(scene.observables, "spectrum") == 0) return;
  constexpr std::int64_t kMostSamplesTogether = std::numeric_limits<std::int32_t>::max();
  const auto& protocol = scene.protocol;
  const std::int64_t samples = std::int64_t{protocol.sampled_revolutions} * protocol.samples_per_revolution;
  if (samples <= kMostSamplesTogether) return;
  fail("/protocol/sampled_revolutions",
       fmt::format(
           "{} with {} samples_per_revolution are {} samples of a spectrum; at most {} are allowed, more "
           "without the observable \"spectrum\"",
           protocol.sampled_revolutions, protocol.samples_per_revolution, samples, kMostSamplesTogether));
}

/// Points that go on from each other do not start from `initial`.
void check_initial_axes(const Scene& scene) {
  if (scene.sweep == Sweep::independent) return;
  for (const auto& swept : scene.grid.swept) {
    if (quantity(swept.pointer).section() != "/initial") continue;
    fail(child("/grid", swept.pointer),
         fmt::format(R"(under the sweep "{}" only the first speed of a line would start from {}; an axis of )"
                     R"(the initial state needs the sweep "independent")",
                     std::get<std::string>(*quantity("/sweep").read(scene)), swept.pointer));
  }
}

/// Pieces need a sweep, whose points go on from each other, and must be able to begin within it.
void check_pieces(const Scene& scene) {
  if (!scene.pieces) return;
  if (scene.sweep == Sweep::independent) {
    fail("/pieces", R"(the sweep is "independent": its points go to all ranks as they are)");
  }
  if (scene.wear && scene.wear->carries_over) {
    fail("/pieces", "/wear/carries_over: blades wear along the whole line, which no piece can begin within");
  }
}

void check_together(const json& document, Scene& scene) {
  check_choosers(document, scene);
  check_clearance(scene);
  check_effects(scene);
  check_spectrum(scene);
  check_initial_axes(scene);
  check_pieces(scene);
  const int highest = scene.protocol.samples_per_revolution / 2;
  if (!document.contains("/spectrum/max_order"_json_pointer)) {
    scene.spectrum.max_order = std::min(std::max(12, 4 * scene.blades.count), highest);
  } else if (scene.spectrum.max_order > highest) {
    fail("/spectrum/max_order",
         fmt::format("{} is outside [1, {}], half of samples_per_revolution; {}", scene.spectrum.max_order,
                     highest, quantity("/spectrum/max_order").meaning));
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

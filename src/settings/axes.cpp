#include "settings/axes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "settings/document.hpp"
#include "settings/evenly_spaced.hpp"
#include "settings/nearest.hpp"
#include "settings/quantity.hpp"
#include "settings/values.hpp"

namespace rubatlas::settings {
namespace {

using nlohmann::json;

constexpr std::size_t kMostAxisValues = 1'000'000;
constexpr double kMostPoints = 1e9;

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
    if (!key.starts_with('/')) continue;
    const auto& entry = quantity(key);
    scene.grid.swept.push_back({key, read_axis(value, child("/grid", key), entry)});
    entry.write(scene, scene.grid.swept.back().values.front());
  }
  std::ranges::sort(scene.grid.swept, {}, [](const PointerAxis& axis) { return axis_name(axis.pointer); });
}

}  // namespace

void read_grid(const nlohmann::json& document, Scene& scene) {
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

}  // namespace rubatlas::settings

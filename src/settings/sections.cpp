#include <algorithm>
#include <array>
#include <utility>

#include "settings/document.hpp"
#include "settings/quantity.hpp"

namespace rubatlas::settings {
namespace {

constexpr std::array kOwnSections{
    Section{.pointer = "/rotor", .meaning = "point mass on a massless isotropic shaft"},
    Section{.pointer = "/blades", .meaning = "equal, massless blades clamped on a hub"},
    Section{.pointer = "/ring", .meaning = "the ring that surrounds the blades"},
    Section{.pointer = "/contact", .meaning = "what happens between a blade tip and the ring"},
    Section{.pointer = "/grid", .meaning = "the values along the axes of the atlas"},
    Section{.pointer = "/pieces",
            .meaning = "the pieces in which several ranks sweep a line",
            .open =
                [](Scene& scene) {
                  if (!scene.pieces) scene.pieces.emplace();
                },
            .may_be_null = true},
    Section{.pointer = "/initial", .meaning = "state of the shaft centre at phase 0"},
    Section{.pointer = "/protocol", .meaning = "how long a point runs and what of it is kept"},
    Section{.pointer = "/spectrum", .meaning = "extent of the amplitude spectrum"},
    Section{.pointer = "/validity", .meaning = "where the model ends"},
    Section{.pointer = "/accuracy", .meaning = "method of integration and its error control"},
};

constexpr std::array kGridAxes{
    GridAxis{.name = "thickness", .quantity = "/blades/thickness", .values = &Grid::thickness},
    GridAxis{.name = "unbalance", .quantity = "/unbalance/moment", .values = &Grid::unbalance},
    GridAxis{.name = "friction", .quantity = "/contact/friction", .values = &Grid::friction},
    GridAxis{.name = "damping_ratio", .quantity = "/rotor/damping_ratio", .values = &Grid::damping_ratio},
    GridAxis{.name = "speed_ratio", .quantity = "/grid/speed_ratio", .values = &Grid::speed_ratio},
};

/// Sections that describe how a motion is computed and stored, not the machine or its start. Their quantities
/// cannot be axes of an atlas.
constexpr std::array<std::string_view, 7> kNotSwept{"",          "/grid",     "/pieces",  "/protocol",
                                                    "/spectrum", "/validity", "/accuracy"};

}  // namespace

std::span<const Section> sections() {
  static const std::vector<Section> entries = [] {
    const auto machine_end = std::ranges::find(kOwnSections, std::string_view("/grid"), &Section::pointer);
    std::vector<Section> all(kOwnSections.begin(), machine_end);
    effects::for_each_effect([&]<auto Effect>() {
      using Settings = std::remove_cvref_t<decltype(*(std::declval<Scene>().*Effect))>;
      all.push_back({.pointer = Settings::kDescription.section,
                     .meaning = Settings::kDescription.meaning,
                     .open = [](Scene& scene) {
                       if (!(scene.*Effect)) (scene.*Effect).emplace();
                     }});
    });
    all.insert(all.end(), machine_end, kOwnSections.end());
    return all;
  }();
  return entries;
}

std::span<const GridAxis> grid_axes() {
  return kGridAxes;
}

std::string axis_name(std::string_view pointer) {
  std::string name(pointer.substr(1));
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

std::vector<const Quantity*> sweepable_quantities() {
  std::vector<const Quantity*> found;
  for (const auto& entry : quantities()) {
    if (entry.kind != Kind::number || std::ranges::count(kNotSwept, entry.section()) > 0) continue;
    if (std::ranges::count(kGridAxes, entry.pointer, &GridAxis::quantity) > 0) continue;
    found.push_back(&entry);
  }
  return found;
}

std::vector<Axis> axes_of(const Scene& scene) {
  std::vector<Axis> axes;
  for (const auto& swept : scene.grid.swept) {
    axes.push_back({axis_name(swept.pointer), &quantity(swept.pointer), swept.values});
  }
  for (const auto& axis : kGridAxes) {
    axes.push_back({std::string(axis.name), &quantity(axis.quantity), scene.grid.*axis.values});
  }
  return axes;
}

const Quantity* quantity_of_axis(std::string_view name) {
  const auto named = std::ranges::find(kGridAxes, name, &GridAxis::name);
  if (named != kGridAxes.end()) return &quantity(named->quantity);
  const auto all = sweepable_quantities();
  const auto found =
      std::ranges::find_if(all, [&](const auto* entry) { return axis_name(entry->pointer) == name; });
  return found == all.end() ? nullptr : *found;
}

std::vector<double> values_in(const Scene& scene, std::string_view pointer) {
  for (auto& axis : axes_of(scene)) {
    if (axis.quantity->pointer == pointer) return std::move(axis.values);
  }
  const auto own = quantity(pointer).read(scene);
  return own ? std::vector{std::get<double>(*own)} : std::vector<double>{};
}

std::string place_of(const Scene& scene, std::string_view pointer) {
  const auto is_it = [pointer](const auto& swept) { return swept.pointer == pointer; };
  if (std::ranges::any_of(scene.grid.swept, is_it)) return child("/grid", pointer);
  const auto named = std::ranges::find(kGridAxes, pointer, &GridAxis::quantity);
  const bool varies = named != kGridAxes.end() && (scene.grid.*named->values).size() > 1;
  return varies ? child("/grid", named->name) : std::string(pointer);
}

}  // namespace rubatlas::settings

#include "settings/scene_checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "settings/document.hpp"
#include "settings/effect_checks.hpp"
#include "settings/quantity.hpp"

namespace rubatlas::settings {
namespace {

/// A quantity that is read only under some words of a choice is refused under the others, as a key and as a
/// grid axis.
void check_choosers(const nlohmann::json& document, const Scene& scene) {
  for (const auto& entry : quantities()) {
    if (entry.chooser.empty() || entry.read(scene)) continue;
    const auto on_the_grid = child("/grid", entry.pointer);
    for (const auto& place : {std::string(entry.pointer), on_the_grid}) {
      const nlohmann::json::json_pointer pointer{place};
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
  if (scene.transformed_signals() == 0) return;
  constexpr std::int64_t kMostSamplesTogether = std::numeric_limits<std::int32_t>::max();
  const auto& protocol = scene.protocol;
  const std::int64_t samples = std::int64_t{protocol.sampled_revolutions} * protocol.samples_per_revolution;
  if (samples <= kMostSamplesTogether) return;
  fail("/protocol/sampled_revolutions",
       fmt::format(
           "{} with {} samples_per_revolution are {} samples of a spectrum; at most {} are allowed, more "
           "without the observables \"spectrum\" and \"full_spectrum\"",
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
void check_pieces(const nlohmann::json& document, Scene& scene) {
  if (!document.contains("pieces") && is_cut_unasked(scene)) scene.pieces.emplace();
  if (!scene.pieces) return;
  if (scene.sweep == Sweep::independent) {
    fail("/pieces", R"(the sweep is "independent": its points go to all ranks as they are)");
  }
  if (scene.wear && scene.wear->carries_over) {
    fail("/pieces", "/wear/carries_over: blades wear along the whole line, which no piece can begin within");
  }
}

}  // namespace

bool is_cut_unasked(const Scene& scene) {
  const std::size_t speeds = scene.grid.speed_ratio.size();
  if (speeds <= Pieces::kLongestWhole || scene.sweep == Sweep::independent) return false;
  if (scene.wear && scene.wear->carries_over) return false;
  std::size_t points = scene.sweep == Sweep::both ? 2 : 1;
  for (const Axis& axis : axes_of(scene)) points *= axis.values.size();
  return points / speeds < Pieces::kManyLines;
}

void check_together(const nlohmann::json& document, Scene& scene) {
  check_choosers(document, scene);
  check_clearance(scene);
  check_effects(scene);
  check_spectrum(scene);
  check_initial_axes(scene);
  check_pieces(document, scene);
  const int highest = scene.protocol.samples_per_revolution / 2;
  if (!document.contains(nlohmann::json::json_pointer("/spectrum/max_order"))) {
    scene.spectrum.max_order = std::min(std::max(12, 4 * scene.blades.count), highest);
  } else if (scene.spectrum.max_order > highest) {
    fail("/spectrum/max_order",
         fmt::format("{} is outside [1, {}], half of samples_per_revolution; {}", scene.spectrum.max_order,
                     highest, quantity("/spectrum/max_order").meaning));
  }
}

}  // namespace rubatlas::settings

#include "analysis/maps_attractors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/maps_datasets.hpp"
#include "analysis/maps_table.hpp"
#include "analysis/rules/attractors.hpp"
#include "analysis/rules/starts.hpp"

namespace rubatlas::analysis {
namespace {

using atlas::Dataset;
using atlas::File;
using atlas::Shape;

void create_basins(File& file, const Findings& found) {
  const auto& basins = found.basins;
  const Starts starts(found.axes);
  std::vector<std::size_t> first(starts.set_count());
  for (std::size_t point = found.attractor.size(); point-- > 0;) first[starts.set_of(point)] = point;
  const std::size_t speeds = found.axes.back().values.size();
  Rows rows(file, "basins", "basin", basins.size(),
            "share of the initial states that leads to each attractor, at each combination of parameters");
  for (const std::size_t axis : starts.parameter_axes()) {
    rows.add<double>(column_of(found.axes[axis]), found.axes[axis].units, found.axes[axis].long_name,
                     [&](std::size_t i) {
                       const std::size_t point = first[basins[i].set];
                       const bool is_speed = axis + 1 == found.axes.size();
                       return is_speed ? found.axes[axis].values[point % speeds]
                                       : found.lines[point / speeds].parameters[axis];
                     });
  }
  rows.add<std::int32_t>("attractor", "1", "number of the attractor, as in /attractor; 0: none",
                         [&](std::size_t i) { return basins[i].attractor; });
  auto motion = rows.add<std::uint8_t>("class", "1", "class of its motion: its period in revolutions",
                                       [&](std::size_t i) { return basins[i].motion; });
  set_class_flags(motion);
  rows.add<std::int32_t>("points", "1", "initial states that lead to it",
                         [&](std::size_t i) { return static_cast<std::int32_t>(basins[i].points); });
  rows.add<double>("share", "1", "share of the initial states whose point is not pending",
                   [&](std::size_t i) { return basins[i].share; });
  rows.add<double>("standard_error", "1", "standard error of the share, sqrt(p (1 - p) / number of points)",
                   [&](std::size_t i) { return basins[i].standard_error; });
  rows.add<double>("max_displacement", "m", "largest displacement on the attractor",
                   [&](std::size_t i) { return basins[i].max_displacement; });
}

void create_hysteresis(File& file, const Findings& found) {
  const auto& ranges = found.hysteresis->ranges;
  Rows rows(file, "hysteresis", "range", ranges.size(),
            "ranges of the speed ratio in which the sweeps up and down find different motions");
  for (std::size_t axis = 1; axis + 1 < found.axes.size(); ++axis) {  // all but direction and speed
    rows.add<double>(column_of(found.axes[axis]), found.axes[axis].units, found.axes[axis].long_name,
                     [&](std::size_t i) { return found.lines[ranges[i].line].parameters[axis]; });
  }
  rows.add<double>("from", "1", "first speed ratio at which the motions differ",
                   [&](std::size_t i) { return ranges[i].from; });
  rows.add<double>("to", "1", "last speed ratio at which the motions differ",
                   [&](std::size_t i) { return ranges[i].to; });
  rows.add<std::int32_t>("points", "1", "speeds at which they differ",
                         [&](std::size_t i) { return static_cast<std::int32_t>(ranges[i].speeds); });
  const auto add_classes = [&](const std::string& name,
                               const std::vector<std::uint8_t> HysteresisRange::*classes) {
    auto dataset = rows.add<std::uint8_t>(
        name, "1", fmt::format("class of the motions of the sweep {}; 0: more than one", name),
        [&](std::size_t i) {
          const auto& all = ranges[i].*classes;
          return all.size() == 1 ? all.front() : std::uint8_t{0};
        });
    set_class_flags(dataset);
  };
  add_classes("up", &HysteresisRange::up);
  add_classes("down", &HysteresisRange::down);
}

}  // namespace

void create_attractors(File& file, const Findings& found, const Shape& shape, std::span<const Dataset> axes) {
  Dataset dataset = create_map<std::int32_t>(
      file, "attractor", shape, axes, found.attractor, "1",
      "number of the attractor among the points that differ in their start only, from 1 in the "
      "order of the points; 0: none");
  dataset.set_text(
      "matching",
      "periodic motions are on one attractor if they have one period and share a section within "
      "max(relative_tolerance * size of the orbit, absolute_tolerance); aperiodic motions if a chain of "
      "aperiodic motions joins them in which the maximum displacements of neighbours differ by no more than "
      "standard_errors of the difference; motions that are not resolved, and points that are not done, have "
      "none");
  set_tolerance(dataset, found, kMatchingFactor);
  dataset.set_number("standard_errors", kStandardErrors);
  if (!found.basins.empty()) create_basins(file, found);
  if (found.hysteresis && !found.hysteresis->ranges.empty()) create_hysteresis(file, found);
}

}  // namespace rubatlas::analysis

#include "analysis/maps_margins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "analysis/maps_datasets.hpp"

namespace rubatlas::analysis {
namespace {

using atlas::Dataset;
using atlas::File;
using atlas::Shape;

void create_grazings(File& file, const Findings& found) {
  const auto& grazings = found.margins->grazings;
  Rows rows(file, "grazings", "grazing", grazings.size(),
            "borders along the speed ratio at which a tip is predicted to graze the ring");
  for (std::size_t axis = 0; axis + 1 < found.axes.size(); ++axis) {
    rows.add<double>(column_of(found.axes[axis]), found.axes[axis].units, found.axes[axis].long_name,
                     [&](std::size_t i) { return found.lines[grazings[i].line].parameters[axis]; });
  }
  const auto& speeds = found.axes.back().values;
  const auto add_speed = [&](const std::string& name, const std::string& long_name, auto value) {
    rows.add<double>(name, "1", long_name, [&](std::size_t i) { return value(grazings[i]); });
  };
  add_speed(column_of(found.axes.back()), "where the trend of the nearest miss reaches zero",
            [](const GrazingBorder& one) { return one.grazing.at; });
  add_speed("error", "difference of the trends of second and first degree",
            [](const GrazingBorder& one) { return one.grazing.error; });
  add_speed("below", "speed ratio of the point below the border",
            [&](const GrazingBorder& one) { return speeds[one.border.below]; });
  add_speed("above", "speed ratio of the point above the border",
            [&](const GrazingBorder& one) { return speeds[one.border.above]; });
  add_speed("from", "speed ratio of the nearest point that shows the trend",
            [&](const GrazingBorder& one) { return speeds[one.grazing.from.front()]; });
  auto side = rows.add<std::uint8_t>("side", "1", "side on which the tip passes the ring",
                                     [&](std::size_t i) { return grazings[i].side; });
  side.set_numbers<std::uint8_t>("flag_values", std::vector<std::uint8_t>{0, 1, 2, 3});
  side.set_text("flag_meanings", "not_known approaching head_on receding");
  rows.add<std::uint8_t>("region_ends", "1", "number of the region that ends there; 0: none",
                         [&](std::size_t i) { return grazings[i].border.region_ends; });
  rows.add<std::uint8_t>("region_begins", "1", "number of the region that begins there; 0: none",
                         [&](std::size_t i) { return grazings[i].border.region_begins; });
}

}  // namespace

void create_margins(File& file, const Findings& found, const Shape& shape, std::span<const Dataset> axes) {
  file.create_group("margins").set_text("long_name", "distances to a change of motion along each parameter");
  for (const AxisMargins& margins : found.margins->axes) {
    const plan::Axis& axis = found.axes[margins.axis];
    // Not the name of the axis alone: xarray refuses a variable named like one of its own dimensions.
    const std::string path = "margins/along_" + axis.name;
    create_map<double>(
        file, path, shape, axes, margins.to_border, axis.units,
        fmt::format("distance in {} to the nearest border, in the middle between two points of "
                    "different class; NaN where there is none",
                    axis.name));
    const bool predicted =
        std::ranges::any_of(margins.to_grazing, [](double at) { return std::isfinite(at); });
    if (!predicted) continue;
    create_map<double>(
        file, path + "_to_grazing", shape, axes, margins.to_grazing, axis.units,
        fmt::format("distance in {}, with its sign, to where the trend of the nearest miss reaches "
                    "zero; NaN where it does not",
                    axis.name));
  }
  if (!found.margins->grazings.empty()) create_grazings(file, found);
}

void create_exponent_check(File& file, const Findings& found, const Shape& shape,
                           std::span<const Dataset> axes) {
  std::vector<std::uint8_t> values;
  values.reserve(found.exponent_check.size());
  for (const ExponentCheck check : found.exponent_check) values.push_back(static_cast<std::uint8_t>(check));
  Dataset dataset =
      create_map<std::uint8_t>(file, "exponent_check", shape, axes, values, "1",
                               "whether the largest exponent is negative where the class is periodic, and "
                               "positive where it is aperiodic");
  dataset.set_numbers<std::uint8_t>("flag_values", std::vector<std::uint8_t>{0, 1, 2, 3});
  dataset.set_text("flag_meanings", "none agrees disagrees zero_within_two_standard_errors");
}

}  // namespace rubatlas::analysis

#include "analysis/maps_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "analysis/edges_file.hpp"
#include "analysis/maps_attractors.hpp"
#include "analysis/maps_datasets.hpp"
#include "analysis/maps_margins.hpp"
#include "analysis/maps_signature.hpp"
#include "analysis/maps_table.hpp"
#include "atlas/hdf5.hpp"
#include "atlas/publish.hpp"
#include "atlas/software.hpp"
#include "settings/identifier.hpp"

namespace rubatlas::analysis {
namespace {

using atlas::Dataset;
using atlas::File;
using atlas::Shape;

std::vector<Dataset> create_axes(File& file, std::span<const plan::Axis> axes) {
  std::vector<Dataset> scales;
  for (const auto& axis : axes) {
    Dataset scale = file.create_dataset<double>(axis.name, {axis.values.size()});
    scale.write<double>(axis.values);
    scale.make_scale(axis.name);
    scale.set_text("units", axis.units);
    scale.set_text("long_name", axis.long_name);
    scales.push_back(std::move(scale));
  }
  return scales;
}

void create_class(File& file, const std::string& name, const std::string& sections, const Findings& found,
                  std::span<const std::uint8_t> motion, const Shape& shape, std::span<const Dataset> axes) {
  Dataset dataset = create_map<std::uint8_t>(file, name, shape, axes, motion, "1",
                                             "class of the motion: its period in " + sections);
  set_class_flags(dataset);
  dataset.set_text(
      "tolerance",
      "sections repeat within max(relative_tolerance * size of the orbit, absolute_tolerance); distance: "
      "Euclidean norm over x, y, vx, vy; size: largest norm of a sampled section state; unresolved: the "
      "orbit closes within unresolved_factor tolerances, or differs between the two halves of the record");
  set_tolerance(dataset, found, 1.0);
  dataset.set_number("unresolved_factor", kUnresolvedFactor);
}

void create_contact(File& file, const Findings& found, const Shape& shape, std::span<const Dataset> axes) {
  std::vector<std::uint8_t> values;
  for (const auto& line : found.lines) {
    for (const auto& point : line.line.contact) values.push_back(static_cast<std::uint8_t>(point.contact));
  }
  Dataset dataset = create_map<std::uint8_t>(file, "contact", shape, axes, values, "1",
                                             "whether any blade touches the ring in the sampled revolutions");
  dataset.set_numbers<std::uint8_t>("flag_values", std::vector<std::uint8_t>{0, 1, 2});
  dataset.set_text("flag_meanings", "not_known no_contact contact");
}

void create_effects(File& file, const Findings& found) {
  std::vector<std::string> parameters;
  std::vector<std::string> fixed;
  std::vector<std::string> subjects;
  std::vector<std::string> effects;
  for (const auto& sensitivity : found.sensitivities) {
    for (const auto& effect : sensitivity.effects) {
      parameters.push_back(found.parameters[sensitivity.parameter].name);
      fixed.push_back(sensitivity.fixed);
      subjects.push_back(effect.subject);
      effects.push_back(effect.text);
    }
  }
  if (effects.empty()) return;
  auto group = file.create_group("effects");
  group.set_text("long_name", "what happens to each region and trigger as one parameter grows");
  const Dataset scale =
      create_number_scale(file, "effects/effect", "effect", effects.size(), "number of the effect");
  create_texts(file, "effects/parameter", scale, "parameter that grows", parameters);
  create_texts(file, "effects/held", scale, "the other parameters", fixed);
  create_texts(file, "effects/subject", scale, "region or trigger", subjects);
  create_texts(file, "effects/text", scale, "what happens to it", effects);
}

/// Period doublings, one row for each of every line.
void create_doublings(File& file, const Findings& found) {
  std::vector<std::pair<const LineSummary*, PeriodDoubling>> doublings;
  std::vector<std::int32_t> lines;
  for (std::size_t line = 0; line < found.lines.size(); ++line) {
    for (const auto& doubling : found.lines[line].doublings) {
      doublings.emplace_back(&found.lines[line], doubling);
      lines.push_back(static_cast<std::int32_t>(line));
    }
  }
  if (doublings.empty()) return;
  Rows rows(file, "doublings", "doubling", doublings.size(),
            fmt::format("where the period of the map over a {} doubles",
                        found.motion_per_passing.empty() ? "revolution" : "blade passing"));
  rows.add<std::int32_t>("line", "1", "number of the line in the atlas, C order",
                         [&](std::size_t i) { return lines[i]; });
  for (std::size_t axis = 0; axis + 1 < found.axes.size(); ++axis) {
    rows.add<double>(column_of(found.axes[axis]), found.axes[axis].units, found.axes[axis].long_name,
                     [&](std::size_t i) { return doublings[i].first->parameters[axis]; });
  }
  rows.add<double>(column_of(found.axes.back()), "1", "speed ratio midway between both periods",
                   [&](std::size_t i) { return doublings[i].second.speed_ratio; });
  rows.add<std::uint8_t>("period", "1", "period below, in sections",
                         [&](std::size_t i) { return doublings[i].second.from_period; });
}

}  // namespace

void write_maps(const atlas::Output& output, const Findings& found, const atlas::AtlasReader& atlas,
                const std::string& atlas_name) {
  atlas::Publication publication(output);
  File file = File::create(publication.name());
  {
    auto root = file.root();
    // The maps depend on the build that wrote the atlas, and on the rules of the present version.
    atlas::write_provenance(std::move(root), software_of(atlas.file()), atlas::FileKind::maps, found.scene);
    auto again = file.root();
    again.set_text("atlas", atlas_name);
    again.set_text("atlas_identifier", settings::identifier_of(found.scene));
    again.set_number<std::int64_t>(kPointsFinished, found.points_finished());
    file.create_text("scene_resolved", atlas.scene_resolved())
        .set_text("long_name", "the scene of the atlas, with every default and every axis value written out");
    const auto shape = atlas.shape();
    const auto axes = create_axes(file, found.axes);
    create_class(file, "class", "revolutions", found, found.motion, shape, axes);
    if (!found.motion_per_passing.empty()) {
      create_class(file, "class_blade_passing", "blade passings", found, found.motion_per_passing, shape,
                   axes);
    }
    if (!found.max_displacement.empty()) {
      create_map<double>(file, "max_displacement", shape, axes, found.max_displacement, "m",
                         "largest displacement, as in the atlas; NaN where the point is not done");
    }
    create_contact(file, found, shape, axes);
    create_table(file, found);
    if (!found.attractor.empty()) create_attractors(file, found, shape, axes);
    if (found.margins) create_margins(file, found, shape, axes);
    if (!found.exponent_check.empty()) create_exponent_check(file, found, shape, axes);
    if (!found.signatures.empty()) create_signature(file, found, shape, axes);
    create_effects(file, found);
    create_doublings(file, found);
    if (found.edges) create_edges(file, found);
  }
  file.close();
  publication.publish();
}

}  // namespace rubatlas::analysis

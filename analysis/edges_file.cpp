#include "analysis/edges_file.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <span>
#include <vector>

#include "analysis/maps_table.hpp"
#include "atlas/hdf5.hpp"
#include "atlas/publish.hpp"
#include "settings/reader.hpp"

namespace rubatlas::analysis {
namespace {

using atlas::Dataset;
using atlas::File;

/// Creates and reads the columns of the group, each under one name.
class Columns {
 public:
  Columns(File& file, std::size_t rows)
      : file_(file), scale_(create_number_scale(file, "edges/edge", "edge", rows, "number of the edge")) {}

  template <atlas::Number T>
  Dataset create(const std::string& name, const std::vector<T>& values, const std::string& long_name) {
    Dataset dataset = file_.create_dataset<T>("edges/" + name, {values.size()});
    dataset.template write<T>(values);
    dataset.attach_scale(0, scale_);
    dataset.set_text("long_name", long_name);
    return dataset;
  }

  void create_flags(const std::string& name, const std::vector<std::uint8_t>& values,
                    const std::string& long_name, const std::vector<std::uint8_t>& flags,
                    const std::string& meanings) {
    Dataset dataset = create(name, values, long_name);
    dataset.set_numbers<std::uint8_t>("flag_values", flags);
    dataset.set_text("flag_meanings", meanings);
  }

 private:
  File& file_;
  Dataset scale_;
};

template <typename T, typename Value>
std::vector<T> column(const std::vector<Edge>& edges, Value value) {
  std::vector<T> values;
  values.reserve(edges.size());
  for (const auto& edge : edges) values.push_back(static_cast<T>(value(edge)));
  return values;
}

void create_classes(Columns& columns, const std::string& name, const std::vector<std::uint8_t>& values,
                    const std::string& long_name) {
  std::vector<std::uint8_t> flags;
  std::string meanings;
  for (std::uint8_t period = 1; period <= motion_class::kLongestPeriod; ++period) {
    flags.push_back(period);
    meanings += fmt::format("period_{} ", period);
  }
  flags.insert(flags.end(), {motion_class::kLeftValidity, motion_class::kAperiodic});
  columns.create_flags(name, values, long_name, flags, meanings + "left_validity aperiodic");
}

}  // namespace

void create_edges(File& file, const Findings& found) {
  const auto& table = *found.edges;
  const auto& edges = table.edges;
  auto group = file.create_group("edges");
  group.set_text("long_name", "where the motion changes along the speed ratio, narrowed down by new points");
  group.set_number("resolution", table.resolution);
  group.set_number<std::uint8_t>("only_regions", table.only_regions ? 1 : 0);
  group.set_number<std::int64_t>(kPointsFinished, found.points_finished());

  Columns columns(file, edges.size());
  columns.create("line", column<std::int32_t>(edges, [](const Edge& edge) { return edge.line; }),
                 "number of the line in the atlas, C order");
  columns.create("border", column<std::int32_t>(edges, [](const Edge& edge) { return edge.border; }),
                 "number of the border of the atlas at which it was found; a border may have several edges");
  for (std::size_t i = 0; i < found.parameters.size(); ++i) {
    const auto& axis = found.axes[i];
    auto values =
        column<double>(edges, [&](const Edge& edge) { return found.lines[edge.line].parameters[i]; });
    columns.create(column_of(axis), values, axis.long_name).set_text("units", axis.units);
  }
  columns
      .create("lower", column<double>(edges, [](const Edge& edge) { return edge.lower; }),
              "speed ratio up to which the motion is that below")
      .set_text("units", "1");
  columns
      .create("upper", column<double>(edges, [](const Edge& edge) { return edge.upper; }),
              "speed ratio from which on the motion is that above")
      .set_text("units", "1");
  columns.create_flags("kind", column<std::uint8_t>(edges, [](const Edge& edge) { return edge.kind; }),
                       "what changes as the speed grows", {1, 2, 3, 4},
                       "another_period aperiodic_begins aperiodic_ends model_validity");
  columns.create_flags("outcome", column<std::uint8_t>(edges, [](const Edge& edge) { return edge.outcome; }),
                       "what was found between lower and upper", {0, 1, 2, 3}, "sharp slow divided overrun");
  create_classes(columns, "class_below",
                 column<std::uint8_t>(edges, [](const Edge& edge) { return edge.motion_below; }),
                 "class of the motion below");
  create_classes(columns, "class_above",
                 column<std::uint8_t>(edges, [](const Edge& edge) { return edge.motion_above; }),
                 "class of the motion above");
  columns.create("region_ends",
                 column<std::uint8_t>(edges, [](const Edge& edge) { return edge.region_ends; }),
                 "number of the region that ends here, 0 for none");
  columns.create("region_begins",
                 column<std::uint8_t>(edges, [](const Edge& edge) { return edge.region_begins; }),
                 "number of the region that begins here, 0 for none");
  columns.create("points", column<std::int32_t>(edges, [](const Edge& edge) { return edge.points; }),
                 "points that were computed for its border");
}

void write_edges(const atlas::Output& output, const Findings& found, const atlas::AtlasReader& atlas,
                 const std::string& atlas_name, const atlas::Software& software) {
  atlas::Publication publication(output);
  File file = File::create(publication.name());
  atlas::write_provenance(file.root(), software, atlas::FileKind::edges, found.scene);
  file.root().set_text("atlas", atlas_name);
  file.create_text("scene_resolved", atlas.scene_resolved())
      .set_text("long_name", "the scene of the atlas, with every default and every axis value written out");
  create_edges(file, found);
  file.close();
  publication.publish();
}

EdgeTable read_edges(const std::filesystem::path& path, const Findings& found,
                     const atlas::AtlasReader& atlas) {
  const File file = File::open_to_read(path);
  const std::string name = path.string();
  if (atlas::kind_of(path) != atlas::FileKind::edges) {
    throw settings::SceneError(fmt::format("{} is no file of edges; rubatlas edges makes one", name));
  }
  if (const auto difference = settings::difference(file.read_text("/scene_resolved"), atlas.scene_resolved());
      !difference.empty()) {
    throw settings::SceneError(fmt::format("{} was made from another scene: {}", name, difference));
  }
  const auto group = file.group("/edges");
  if (const double finished = group.number(kPointsFinished);
      finished != static_cast<double>(found.points_finished())) {
    throw settings::SceneError(fmt::format(
        "{} was made when {} of the atlas's points were finished, and now there are {}; make it again", name,
        finished, found.points_finished()));
  }
  EdgeTable table{.resolution = group.number("resolution"),
                  .only_regions = group.number("only_regions") != 0.0};
  const auto read = [&]<typename T>(const char* column, T) {
    return file.dataset(std::string("/edges/") + column).read<T>();
  };
  const auto lines = read("line", std::int32_t{});
  const auto borders = read("border", std::int32_t{});
  const auto lower = read("lower", double{});
  const auto upper = read("upper", double{});
  const auto kind = read("kind", std::uint8_t{});
  const auto outcome = read("outcome", std::uint8_t{});
  const auto below = read("class_below", std::uint8_t{});
  const auto above = read("class_above", std::uint8_t{});
  const auto ends = read("region_ends", std::uint8_t{});
  const auto begins = read("region_begins", std::uint8_t{});
  const auto points = read("points", std::int32_t{});
  for (std::size_t i = 0; i < lines.size(); ++i) {
    table.edges.push_back({.line = static_cast<std::size_t>(lines[i]),
                           .border = static_cast<std::size_t>(borders[i]),
                           .kind = static_cast<BorderKind>(kind[i]),
                           .motion_below = below[i],
                           .motion_above = above[i],
                           .region_ends = ends[i],
                           .region_begins = begins[i],
                           .lower = lower[i],
                           .upper = upper[i],
                           .outcome = static_cast<EdgeOutcome>(outcome[i]),
                           .points = static_cast<std::size_t>(points[i])});
  }
  return table;
}

}  // namespace rubatlas::analysis

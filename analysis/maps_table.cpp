#include "analysis/maps_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <span>
#include <vector>

namespace rubatlas::analysis {
namespace {

using atlas::Dataset;
using atlas::File;

/// One column of the table of lines.
struct Column {
  std::string name;
  std::string units;
  std::string long_name;
  std::function<double(const LineSummary&)> value;
};

std::vector<Column> columns_of(const Findings& found) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < found.parameters.size(); ++i) {
    columns.push_back({column_of(found.axes[i]), found.axes[i].units, found.axes[i].long_name,
                       [i](const LineSummary& line) { return line.parameters[i]; }});
  }
  const auto add_contact = [&](const char* name, const char* units, const char* meaning,
                               double ContactSummary::*member) {
    columns.push_back(
        {name, units, meaning, [member](const LineSummary& line) { return line.contact.*member; }});
  };
  add_contact("first_contact", "1", "lowest speed ratio at which a blade touches; NaN where none does",
              &ContactSummary::first);
  add_contact("last_contact", "1", "highest speed ratio at which a blade touches; NaN where none does",
              &ContactSummary::last);
  add_contact("closest_distance", "m", "least distance between a tip and the ring where nothing touches",
              &ContactSummary::closest_distance);
  add_contact("closest_speed", "1", "speed ratio of the least distance", &ContactSummary::closest_speed);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto add = [&](const char* name, const char* units, const char* meaning, double Region::*member) {
      columns.push_back({fmt::format("region_{}_{}", i + 1, name), units,
                         fmt::format("region {}: {}", i + 1, meaning),
                         [i, member](const LineSummary& line) { return line.regions[i].*member; }});
    };
    add("from", "1", "first speed ratio; NaN unless present", &Region::from);
    add("to", "1", "last speed ratio; NaN unless present", &Region::to);
    if (found.edges) {
      const auto add_end = [&](const char* name, const char* meaning, Interval Region::*end,
                               double Interval::*side) {
        columns.push_back({fmt::format("region_{}_{}", i + 1, name), "1",
                           fmt::format("region {}: {}; NaN where no edge is known", i + 1, meaning),
                           [i, end, side](const LineSummary& line) { return line.regions[i].*end.*side; }});
      };
      add_end("from_lower", "speed ratio above which it begins", &Region::from_between, &Interval::lower);
      add_end("from_upper", "speed ratio below which it begins", &Region::from_between, &Interval::upper);
      add_end("to_lower", "speed ratio above which it ends", &Region::to_between, &Interval::lower);
      add_end("to_upper", "speed ratio below which it ends", &Region::to_between, &Interval::upper);
    }
    add("aperiodic_share", "1", "share of aperiodic points among the periodic and aperiodic ones",
        &Region::aperiodic_share);
    add("peak_displacement", "m", "largest displacement", &Region::peak_displacement);
    add("median_displacement", "m", "median of the largest displacements", &Region::median_displacement);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const auto add = [&](const char* name, const char* units, const char* meaning, auto value) {
      columns.push_back({fmt::format("trigger_{}_{}", i + 1, name), units,
                         fmt::format("trigger {}: {}", i + 1, meaning),
                         [i, value](const LineSummary& line) { return value(line.triggers[i]); }});
    };
    add("speed_ratio", "1", "speed ratio; NaN unless present",
        [](const Trigger& t) { return t.speed_ratio; });
    add("rise", "m", "growth of the displacement across it", [](const Trigger& t) { return t.rise(); });
    add("ratio", "1", "displacement above over displacement below",
        [](const Trigger& t) { return t.ratio(); });
  }
  return columns;
}

void create_presence(File& file, const std::string& name, const std::string& long_name,
                     const Dataset& line_scale, std::span<const std::uint8_t> values) {
  Dataset dataset = file.create_dataset<std::uint8_t>("table1/" + name, {values.size()});
  dataset.write<std::uint8_t>(values);
  dataset.attach_scale(0, line_scale);
  const std::vector<std::uint8_t> flags{0, 1, 2, 3};
  dataset.set_numbers<std::uint8_t>("flag_values", flags);
  dataset.set_text("flag_meanings", "not_covered absent present merged_with_region_2");
  dataset.set_text("long_name", long_name);
}

/// The ends of a region beyond which it may go on.
void create_open_ends(File& file, std::size_t region, const Findings& found, const Dataset& line_scale) {
  std::vector<std::uint8_t> values;
  for (const auto& line : found.lines) {
    const auto& here = line.regions[region];
    values.push_back(static_cast<std::uint8_t>((here.begins_open ? 1 : 0) + (here.ends_open ? 2 : 0)));
  }
  Dataset dataset =
      file.create_dataset<std::uint8_t>(fmt::format("table1/region_{}_open", region + 1), {values.size()});
  dataset.write<std::uint8_t>(values);
  dataset.attach_scale(0, line_scale);
  const std::vector<std::uint8_t> flags{0, 1, 2, 3};
  dataset.set_numbers<std::uint8_t>("flag_values", flags);
  dataset.set_text("flag_meanings", "closed begins_open ends_open both");
  dataset.set_text(
      "long_name",
      fmt::format(
          "region {}: ends beyond which it may go on: at points that are not done, or at the end of the grid",
          region + 1));
}

}  // namespace

std::string column_of(const plan::Axis& axis) {
  return "at_" + axis.name;
}

void create_texts(File& file, const std::string& path, const Dataset& scale, const std::string& long_name,
                  const std::vector<std::string>& texts) {
  Dataset dataset = file.create_texts(path, texts);
  dataset.attach_scale(0, scale);
  dataset.set_text("long_name", long_name);
}

Dataset create_number_scale(File& file, const std::string& path, const std::string& name, std::size_t size,
                            const std::string& long_name) {
  Dataset scale = file.create_dataset<std::int32_t>(path, {size});
  std::vector<std::int32_t> numbers(size);
  for (std::size_t i = 0; i < size; ++i) numbers[i] = static_cast<std::int32_t>(i);
  scale.write<std::int32_t>(numbers);
  scale.make_scale(name);
  scale.set_text("units", "1");
  scale.set_text("long_name", long_name);
  return scale;
}

void set_class_flags(Dataset& dataset) {
  std::vector<std::uint8_t> values{motion_class::kNone};
  std::vector<std::string> meanings{"none"};
  for (std::uint8_t period = 1; period <= motion_class::kLongestPeriod; ++period) {
    values.push_back(period);
    meanings.push_back(fmt::format("period_{}", period));
  }
  values.insert(values.end(), {motion_class::kUnresolved, motion_class::kAperiodic});
  meanings.insert(meanings.end(), {"unresolved", "aperiodic"});
  dataset.set_numbers<std::uint8_t>("flag_values", values);
  dataset.set_text("flag_meanings", fmt::format("{}", fmt::join(meanings, " ")));
}

void set_tolerance(Dataset& dataset, const Findings& found, double factor) {
  dataset.set_number("relative_tolerance", factor * found.tolerance.front().relative);
  std::vector<double> floors;
  for (const auto& tolerance : found.tolerance) floors.push_back(factor * tolerance.floor);
  if (std::ranges::count(floors, floors.front()) == std::ssize(floors)) {
    dataset.set_number("absolute_tolerance", floors.front());
  } else {  // lengths are swept
    dataset.set_numbers<double>("absolute_tolerance", floors);
  }
}

void create_table(File& file, const Findings& found) {
  auto group = file.create_group("table1");
  group.set_text("long_name", "regions and triggers, one row per line of the atlas");
  const Dataset scale = create_number_scale(file, "table1/line", "line", found.lines.size(),
                                            "number of the line in the atlas, C order");
  for (const auto& column : columns_of(found)) {
    std::vector<double> values;
    for (const auto& line : found.lines) values.push_back(column.value(line));
    Dataset dataset = file.create_dataset<double>("table1/" + column.name, {values.size()});
    dataset.write<double>(values);
    dataset.attach_scale(0, scale);
    dataset.set_text("units", column.units);
    dataset.set_text("long_name", column.long_name);
  }
  std::vector<std::string> contacts;
  for (const auto& line : found.lines) contacts.push_back(line.contact.text);
  create_texts(file, "table1/contact", scale, "where blades touch the ring", contacts);
  std::vector<std::uint8_t> presence(found.lines.size());
  const auto create = [&](const std::string& name, const std::string& long_name, auto presence_of) {
    for (std::size_t i = 0; i < presence.size(); ++i) {
      presence[i] = static_cast<std::uint8_t>(presence_of(found.lines[i]));
    }
    create_presence(file, name, long_name, scale, presence);
  };
  for (std::size_t i = 0; i < 4; ++i) {
    create(fmt::format("region_{}_presence", i + 1), fmt::format("whether region {} is there", i + 1),
           [i](const LineSummary& line) { return line.regions[i].presence; });
    create_open_ends(file, i, found, scale);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    create(fmt::format("trigger_{}_presence", i + 1), fmt::format("whether trigger {} is there", i + 1),
           [i](const LineSummary& line) { return line.triggers[i].presence; });
  }
}

}  // namespace rubatlas::analysis

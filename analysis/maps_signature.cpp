#include "analysis/maps_signature.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "analysis/maps_datasets.hpp"

namespace rubatlas::analysis {

void create_signature(atlas::File& file, const Findings& found, const atlas::Shape& shape,
                      std::span<const atlas::Dataset> axes) {
  constexpr std::array<const char*, kSignNames.size()> kMeanings{"line at the order of the blade passing",
                                                                 "broad band between the whole orders",
                                                                 "highest line between the whole orders"};
  const auto& lines = found.signatures;
  Rows rows(file, "signature", "line", lines.size(),
            "signs of rubbing in the spectrum before the displacement passes a limit");
  for (std::size_t axis = 0; axis + 1 < found.axes.size(); ++axis) {
    rows.add<double>(column_of(found.axes[axis]), found.axes[axis].units, found.axes[axis].long_name,
                     [&](std::size_t i) { return found.lines[i].parameters[axis]; });
  }
  rows.add<double>("limit", "m", "displacement that is not to be passed",
                   [&](std::size_t i) { return lines[i].limit; });
  rows.add<double>("limit_speed_ratio", "1",
                   "first speed ratio at which it is passed; NaN: none that is done",
                   [&](std::size_t i) { return lines[i].limit_speed_ratio; });
  rows.add<double>("announced_speed_ratio", "1",
                   "earliest speed ratio of the signs that stand there; NaN: none",
                   [&](std::size_t i) { return lines[i].announced(); });
  const auto add_sign = [&](std::string_view name, std::string_view meaning, auto sign_of) {
    rows.add<double>(fmt::format("{}_speed_ratio", name), "1",
                     fmt::format("{}: speed ratio of the sign that stands at the limit; NaN: none", meaning),
                     [&](std::size_t i) { return sign_of(lines[i]).speed_ratio; });
    rows.add<std::int32_t>(
        fmt::format("{}_false", name), "1",
        fmt::format("{}: number of signs without the limit being passed", meaning),
        [&](std::size_t i) { return static_cast<std::int32_t>(sign_of(lines[i]).false_signs); });
  };
  add_sign("displacement", "displacement itself, for comparison",
           [](const LineSignature& line) { return line.displacement; });
  file.create_group("signs").set_text("long_name", "heights in the spectrum from which signs are found");
  for (std::size_t sign = 0; sign < kSignNames.size(); ++sign) {
    add_sign(kSignNames[sign], kMeanings[sign],
             [sign](const LineSignature& line) { return line.signs[sign]; });
    std::vector<double> heights;
    for (const auto& one : found.sign_heights) heights.push_back(one[sign]);
    create_map<double>(file, fmt::format("signs/{}", kSignNames[sign]), shape, axes, heights, "m",
                       fmt::format("{}, amplitude", kMeanings[sign]));
  }
}

}  // namespace rubatlas::analysis

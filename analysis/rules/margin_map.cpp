#include "analysis/rules/margin_map.hpp"

#include <algorithm>
#include <iterator>

#include "analysis/rules/starts.hpp"

namespace rubatlas::analysis {
namespace {

/// The points of an atlas along one axis: `count` of them, `stride` apart.
struct PointsAlong {
  std::size_t first;
  std::size_t stride;
  std::size_t count;

  [[nodiscard]] std::size_t point(std::size_t i) const { return first + i * stride; }
};

MotionsAlong motions_along(const PointsAlong& points, std::span<const double> values,
                           const MarginRows& rows) {
  MotionsAlong motions{.values = {values.begin(), values.end()}, .motion = {}, .nearest_miss = {}};
  for (std::size_t i = 0; i < points.count; ++i) {
    const std::size_t point = points.point(i);
    motions.motion.push_back(rows.motion[point]);
    motions.nearest_miss.push_back(rows.nearest_miss.empty() ? kNotANumber : rows.nearest_miss[point]);
  }
  return motions;
}

AxisMargins margins_along(std::size_t axis, std::span<const plan::Axis> axes, const MarginRows& rows) {
  const std::size_t points = rows.motion.size();
  AxisMargins margins{.axis = axis,
                      .to_border = std::vector<double>(points, kNotANumber),
                      .to_grazing = std::vector<double>(points, kNotANumber)};
  const auto& values = axes[axis].values;
  std::size_t stride = 1;
  for (std::size_t i = axis + 1; i < axes.size(); ++i) stride *= axes[i].values.size();
  for (std::size_t first = 0; first < points; ++first) {
    if (first / stride % values.size() != 0) continue;  // not the first of its row
    const PointsAlong row{first, stride, values.size()};
    const auto motions = motions_along(row, values, rows);
    const auto to_border = distances_to_borders(motions);
    for (std::size_t i = 0; i < row.count; ++i) {
      margins.to_border[row.point(i)] = to_border[i];
      if (const auto grazing = predicted_grazing(motions, i))
        margins.to_grazing[row.point(i)] = grazing->at - values[i];
    }
  }
  return margins;
}

std::vector<GrazingBorder> grazings_of(std::size_t line, const LineSummary& summary, const MarginRows& rows) {
  const std::size_t speeds = summary.line.size();
  const PointsAlong along{line * speeds, 1, speeds};
  const auto motions = motions_along(along, summary.line.speed_ratio, rows);
  std::vector<GrazingBorder> grazings;
  for (auto& border : find_borders(motions.motion)) {
    const auto grazing = grazing_at(motions, border);
    if (!grazing) continue;
    note_regions(border, summary.line, summary.regions);
    const std::size_t nearest = along.point(grazing->from.front());
    grazings.push_back(
        {line, border, *grazing, rows.miss_side.empty() ? std::uint8_t{0} : rows.miss_side[nearest]});
  }
  return grazings;
}

}  // namespace

Margins find_margins(std::span<const plan::Axis> axes, const MarginRows& rows,
                     std::span<const LineSummary> lines) {
  Margins margins;
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    if (axes[axis].values.size() > 1 && !is_start_axis(axes[axis].name))
      margins.axes.push_back(margins_along(axis, axes, rows));
  }
  for (std::size_t line = 0; line < lines.size(); ++line)
    std::ranges::move(grazings_of(line, lines[line], rows), std::back_inserter(margins.grazings));
  return margins;
}

}  // namespace rubatlas::analysis

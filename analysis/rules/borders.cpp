#include "analysis/rules/borders.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "analysis/rules/class.hpp"

namespace rubatlas::analysis {

std::vector<std::uint8_t> border_motions(std::vector<std::uint8_t> classes,
                                         std::span<const std::uint8_t> status) {
  constexpr std::uint8_t kLeft = 2;  // of the atlas' flags
  for (std::size_t i = 0; i < classes.size(); ++i) {
    if (status[i] == kLeft) classes[i] = motion_class::kLeftValidity;
  }
  return classes;
}

std::vector<Border> find_borders(std::span<const std::uint8_t> motion) {
  std::vector<Border> borders;
  const std::size_t none = motion.size();
  std::size_t last = none;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    if (motion[i] == motion_class::kNone) last = none;
    if (motion[i] == motion_class::kNone || motion[i] == motion_class::kUnresolved) continue;
    if (last != none && motion[last] != motion[i]) borders.push_back({last, i});
    last = i;
  }
  return borders;
}

BorderKind kind_of_border(std::uint8_t below, std::uint8_t above) {
  if (below == motion_class::kLeftValidity || above == motion_class::kLeftValidity)
    return BorderKind::validity;
  if (is_periodic(below) && is_periodic(above)) return BorderKind::period;
  return is_periodic(below) ? BorderKind::onset : BorderKind::end;
}

void note_regions(Border& border, const Line& line, const std::array<Region, 4>& regions) {
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const Region& region = regions[i];
    const auto number = static_cast<std::uint8_t>(i + 1);
    if (!region.present()) continue;
    if (!region.begins_open && line.speed_ratio[border.above] == region.from) border.region_begins = number;
    if (i > 0 && !region.ends_open && line.speed_ratio[border.below] == region.to)
      border.region_ends = number;
  }
}

std::vector<Edge> edges_of(std::size_t line, std::size_t number, const Border& border,
                           const EdgeSearch& search) {
  std::vector<Edge> edges;
  for (const auto& found : search.edges()) {
    Edge edge{.line = line,
              .border = number,
              .motion_below = found.near_motion,
              .motion_above = found.far_motion,
              .lower = found.near_speed,
              .upper = found.far_speed,
              .outcome = found.outcome,
              .points = search.points()};
    if (!search.is_ascending()) {
      std::swap(edge.motion_below, edge.motion_above);
      std::swap(edge.lower, edge.upper);
    }
    edge.kind = kind_of_border(edge.motion_below, edge.motion_above);
    edges.push_back(edge);
  }
  if (!search.is_ascending()) std::ranges::reverse(edges);
  edges.front().region_ends = border.region_ends;
  edges.back().region_begins = border.region_begins;
  return edges;
}

void narrow_ends(std::array<Region, 4>& regions, const Edge& edge) {
  if (edge.outcome == EdgeOutcome::overrun) return;  // where it is has not been found
  const Interval between{edge.lower, edge.upper};
  if (edge.region_begins > 0) regions.at(edge.region_begins - 1U).from_between = between;
  if (edge.region_ends > 0) regions.at(edge.region_ends - 1U).to_between = between;
}

std::string motion_text(std::uint8_t motion) {
  if (is_periodic(motion)) return fmt::format("period {}", motion);
  return motion == motion_class::kLeftValidity ? "motion outside the model" : "aperiodic motion";
}

}  // namespace rubatlas::analysis

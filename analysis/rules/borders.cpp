#include "analysis/rules/borders.hpp"

#include <fmt/format.h>

#include "analysis/rules/class.hpp"

namespace rubatlas::analysis {

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

void note_regions(Edge& edge, const Line& line, const std::array<Region, 4>& regions, const Border& border) {
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const Region& region = regions[i];
    const auto number = static_cast<std::uint8_t>(i + 1);
    if (!region.present()) continue;
    if (!region.begins_at_gap && line.speed_ratio[border.above] == region.from) edge.region_begins = number;
    if (i > 0 && !region.ends_at_gap && line.speed_ratio[border.below] == region.to)
      edge.region_ends = number;
  }
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

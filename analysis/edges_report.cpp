#include "analysis/edges_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>

#include "analysis/report_parts.hpp"
#include "analysis/rules/evidence_text.hpp"
#include "analysis/text_layout.hpp"
#include "plan/grid.hpp"

namespace rubatlas::analysis {
namespace {

/// "at Ω = 0.4393415(5)" or "between Ω = 0.439341 and 0.440121".
std::string place_of(const Edge& edge, double resolution) {
  if (edge.outcome == EdgeOutcome::sharp) return "at Ω = " + speed_text({edge.lower, edge.upper});
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(resolution))), 3, 12);
  return fmt::format("between Ω = {:.{}f} and {:.{}f}", edge.lower, digits, edge.upper, digits);
}

std::string sides_of(const Edge& edge) {
  return fmt::format("{} below, {} above", motion_text(edge.motion_below), motion_text(edge.motion_above));
}

std::string text_of(const Edge& edge, const Findings& found) {
  const auto place = place_of(edge, found.edges->resolution);
  switch (edge.outcome) {
    case EdgeOutcome::sharp:
      return fmt::format("{} {}: {}", border_text(edge.region_ends, edge.region_begins), place,
                         sides_of(edge));
    case EdgeOutcome::slow:
      return fmt::format("{} {}, where motions settle too slowly for their class to be known: {}",
                         border_text(edge.region_ends, edge.region_begins), place, sides_of(edge));
    case EdgeOutcome::divided:
      return fmt::format("{} {}, where motions alternate, and the border goes on dividing: {}",
                         border_text(edge.region_ends, edge.region_begins), place, sides_of(edge));
    case EdgeOutcome::overrun:
      break;
  }
  const bool up = plan::Grid(found.scene).direction(edge.line) == plan::Direction::up;
  const double last = up ? edge.upper : edge.lower;
  const bool is_last = edge.lower == edge.upper;  // of the grid, where nothing lies between
  return fmt::format(
      "{} {}, or behind it: a sweep in shorter steps finds at Ω = {:.6g} another motion than the atlas: {}",
      border_text(edge.region_ends, edge.region_begins), is_last ? fmt::format("at Ω = {:.6g}", last) : place,
      last, sides_of(edge));
}

const Edge* find_edge(const Findings& found, std::size_t line, std::uint8_t Edge::*role,
                      std::uint8_t region) {
  const auto edge = std::ranges::find_if(found.edges->edges, [&](const Edge& one) {
    return one.line == line && one.*role == region && one.outcome != EdgeOutcome::overrun;
  });
  return edge == found.edges->edges.end() ? nullptr : &*edge;
}

/// What the sweeps up and down say of an end of a region; empty where one of them has no such end.
std::string both_ways(const Findings& found, std::size_t up_line, std::size_t down_line,
                      std::uint8_t Edge::*role, std::uint8_t region) {
  const Edge* const up = find_edge(found, up_line, role, region);
  const Edge* const down = find_edge(found, down_line, role, region);
  if (up == nullptr || down == nullptr) return "";
  const auto subject = fmt::format("region {} {}", region, role == &Edge::region_begins ? "begins" : "ends");
  const double resolution = found.edges->resolution;
  const bool same = up->lower <= down->upper + resolution && down->lower <= up->upper + resolution;
  return fmt::format("{} {} as the speed grows, and {} as it falls: {}", subject, place_of(*up, resolution),
                     place_of(*down, resolution),
                     same ? "the sweeps agree" : "in between the motion depends on the way of the sweep");
}

void add_both_ways(const Findings& found, std::vector<std::string>& sentences) {
  if (found.axes.front().name != plan::kDirectionAxis) return;
  const std::size_t lines = found.lines.size() / 2;
  for (std::size_t line = 0; line < lines; ++line) {
    for (std::uint8_t region = 1; region <= 4; ++region) {
      for (const auto role : {&Edge::region_begins, &Edge::region_ends}) {
        auto text = both_ways(found, line, line + lines, role, region);
        if (!text.empty()) sentences.push_back(line_text(found, line, plan::kDirectionAxis) + text + ".");
      }
    }
  }
}

}  // namespace

std::vector<std::string> edge_sentences(const Findings& found) {
  std::vector<std::string> sentences;
  const auto& edges = found.edges->edges;
  const std::string_view of_regions = found.edges->only_regions ? " of regions" : "";
  if (edges.empty()) return {fmt::format("Edges: none; there are no borders{}.", of_regions)};
  const auto is_of_region = [](const Edge& edge) { return edge.region_begins > 0 || edge.region_ends > 0; };
  std::size_t points = 0;
  std::size_t borders = 0;
  std::array<std::size_t, 4> counts{};
  for (std::size_t first = 0; first < edges.size(); ++borders) {
    std::size_t end = first;
    while (end < edges.size() && edges[end].border == edges[first].border) ++end;
    const auto all = std::span(edges).subspan(first, end - first);
    points += all.front().points;
    for (const auto& edge : all) {
      ++counts.at(static_cast<std::size_t>(edge.outcome));
      // What a border of a region passes through is told too.
      if (std::ranges::any_of(all, is_of_region))
        sentences.push_back(line_text(found, edge.line) + text_of(edge, found) + ".");
    }
    first = end;
  }
  add_both_ways(found, sentences);
  const auto& [sharp, slow, divided, overrun] = counts;
  sentences.push_back(fmt::format(
      "Edges: {} at {} borders{}: {} sharp, within {:g}; {} where motions settle too slowly; {} that go on "
      "dividing; {} that depend on the steps of the sweep; {} points computed.",
      edges.size(), borders, of_regions, sharp, found.edges->resolution, slow, divided, overrun, points));
  return sentences;
}

std::string edges_report(const Findings& found) {
  std::string text;
  for (const auto& sentence : edge_sentences(found)) text += paragraph("", sentence, 2, kColumns);
  return text;
}

}  // namespace rubatlas::analysis

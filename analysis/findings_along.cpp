#include "analysis/findings_along.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace rubatlas::analysis {
namespace {

/// "no region 2", "region 4 merged with 2": what a line has not of the four regions.
std::vector<std::string> what_lacks(const LineSummary& line) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < line.regions.size(); ++i) {
    const auto presence = line.regions[i].presence;
    if (presence == Presence::absent) texts.push_back(fmt::format("no region {}", i + 1));
    if (presence == Presence::merged) texts.push_back(fmt::format("region {} merged with 2", i + 1));
  }
  return texts;
}

/// All four regions on each of the lines: false where one is known not to be there, not covered where one
/// might be where the points are not done.
}  // namespace

Finding not_covered(std::string reason) {
  return {std::nullopt, std::move(reason)};
}

std::string no_lines(const Evidence& evidence, const Lines& lines, std::string_view name) {
  if (!evidence.other_rotor().empty()) return evidence.other_rotor();
  if (lines.size() >= 2) return {};
  return fmt::format("the grid has {} of the default rotor along {}",
                     lines.empty() ? "no line" : "only one line", name);
}

Lines within(const Evidence& evidence, const Lines& lines, std::string_view name, double low, double high) {
  Lines inside;
  std::ranges::copy_if(lines, std::back_inserter(inside), [&](const LineSummary* line) {
    const double value = evidence.value(*line, name);
    return value * kRounding >= low && value <= high * kRounding;
  });
  return inside;
}

Finding all_four(const Evidence& evidence, const Lines& lines, std::string_view name) {
  std::vector<std::string> lacking;
  std::vector<std::string> unknown;
  for (const auto* line : lines) {
    const auto lacks = what_lacks(*line);
    const bool uncovered = std::ranges::any_of(
        line->regions, [](const Region& region) { return region.presence == Presence::not_covered; });
    const auto at = evidence.value_text(*line, name);
    if (!lacks.empty()) lacking.push_back(fmt::format("{} at {}", fmt::join(lacks, ", "), at));
    if (lacks.empty() && uncovered) unknown.push_back(at);
  }
  if (!lacking.empty()) return {false, fmt::format("{}", fmt::join(lacking, "; "))};
  if (!unknown.empty())
    return not_covered(fmt::format("not all regions are covered at {}", fmt::join(unknown, ", ")));
  return {true, fmt::format("all four regions from {} to {}", evidence.value_text(*lines.front(), name),
                            evidence.value_text(*lines.back(), name))};
}

}  // namespace rubatlas::analysis

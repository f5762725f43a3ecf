#include "analysis/paper/findings_along.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/rules/evidence_text.hpp"

namespace rubatlas::analysis {
namespace {

/// "no region 2", "region 4 merged with 2": the regions that a line lacks.
std::vector<std::string> what_lacks(const LineSummary& line) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < line.regions.size(); ++i) {
    const auto presence = line.regions[i].presence;
    if (presence == Presence::absent) texts.push_back(fmt::format("no region {}", i + 1));
    if (presence == Presence::merged) texts.push_back(fmt::format("region {} merged with 2", i + 1));
  }
  return texts;
}

}  // namespace

Finding not_covered(std::string reason, std::string claim) {
  return {std::nullopt, std::move(reason), std::move(claim)};
}

bool has_all_four(const LineSummary& line) {
  return std::ranges::all_of(line.regions, &Region::present);
}

std::string no_lines(const Evidence& evidence, const Lines& lines, std::string_view name) {
  if (!evidence.other_rotor().empty()) return evidence.other_rotor();
  if (lines.size() >= 2) return {};
  return fmt::format("the grid has {} of {} along {}", lines.empty() ? "no line" : "only one line",
                     evidence.rotor().name, name);
}

Lines within(const Evidence& evidence, const Lines& lines, std::string_view name, double low, double high) {
  Lines inside;
  std::ranges::copy_if(lines, std::back_inserter(inside), [&](const LineSummary* line) {
    const double value = evidence.value(*line, name);
    return value * kRounding >= low && value <= high * kRounding;
  });
  return inside;
}

Finding all_four(const Evidence& evidence, const Lines& lines, std::string_view name, std::string claim) {
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
  const auto brief = fmt::format("{}/{}", lines.size() - lacking.size() - unknown.size(), lines.size());
  if (!lacking.empty()) {
    return {false, fmt::format("{}", fmt::join(lacking, "; ")), std::move(claim), brief};
  }
  if (!unknown.empty()) {
    return not_covered(fmt::format("not all regions are covered at {}", fmt::join(unknown, ", ")),
                       std::move(claim));
  }
  return {true,
          fmt::format("all four regions from {} to {}", evidence.value_text(*lines.front(), name),
                      evidence.value_text(*lines.back(), name)),
          std::move(claim), brief};
}

Finding trigger_at_its_place(const LineSummary& line, SpeedScale scale, std::size_t which) {
  const auto& trigger = line.triggers[which];
  const auto text = trigger_text(static_cast<int>(which) + 1, trigger);
  const auto claim = fmt::format("trigger {} at {}/n", which + 1, which + 1);
  if (trigger.presence == Presence::not_covered) return not_covered(text, claim);
  if (trigger.presence != Presence::present) return {false, text, claim};
  const double scaled = scale.scaled(trigger.speed_ratio);
  return {std::abs(scaled - kNominalTrigger.at(which)) <= kSamePlace,
          fmt::format("{}; {:.3f}/n", text, 3.0 * scaled), claim, fmt::format("{:.3f}/n", 3.0 * scaled)};
}

Finding trigger_on_every(const Evidence& evidence, const Lines& lines, std::string_view name,
                         std::size_t which, std::string_view of) {
  auto claim = fmt::format("{}: trigger {} at {}/n", of, which + 1, which + 1);
  std::vector<std::string> departures;
  std::vector<std::string> unknown;
  double lowest = kNotANumber;
  double highest = kNotANumber;
  for (const auto* line : lines) {
    const auto one = trigger_at_its_place(*line, evidence.scale(), which);
    const auto& trigger = line->triggers.at(which);
    if (!one.holds) unknown.push_back(evidence.value_text(*line, name));
    if (one.holds == false) {
      departures.push_back(fmt::format("{} at {}", trigger_text(static_cast<int>(which) + 1, trigger),
                                       evidence.value_text(*line, name)));
    }
    lowest = std::fmin(lowest, trigger.speed_ratio);
    highest = std::fmax(highest, trigger.speed_ratio);
  }
  const auto brief = fmt::format("{}/{}", lines.size() - departures.size() - unknown.size(), lines.size());
  if (!departures.empty())
    return {false, fmt::format("{}", fmt::join(departures, "; ")), std::move(claim), brief};
  if (!unknown.empty()) {
    return not_covered(fmt::format("trigger {} is not covered at {}", which + 1, fmt::join(unknown, ", ")),
                       std::move(claim));
  }
  return {true, fmt::format("trigger {} on every line, at {:.3f}-{:.3f}", which + 1, lowest, highest),
          std::move(claim), brief};
}

}  // namespace rubatlas::analysis

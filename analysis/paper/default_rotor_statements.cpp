// P1 to P4 (MODEL 6.3): the four regions and two triggers of the default rotor.
#include <fmt/format.h>

#include <cmath>

#include "analysis/paper/statements.hpp"
#include "analysis/rules/evidence_text.hpp"

namespace rubatlas::analysis {
namespace {

std::optional<bool> if_covered(Presence presence, bool holds) {
  if (presence == Presence::not_covered) return std::nullopt;
  return holds;
}

constexpr const char* kDoubling = "a period doubles at 2/3";

/// Text for a cell of the statement map; empty where the region or trigger is absent.
std::string brief_extent(const Region& region) {
  return region.present() ? fmt::format("{:.2f}-{:.2f}", region.from, region.to) : "";
}
std::string place_text(const Trigger& trigger) {
  return trigger.presence == Presence::present ? fmt::format("{:.3f}", trigger.speed_ratio) : "";
}

std::vector<Finding> region_1_findings(const LineSummary& line, SpeedScale scale) {
  const auto& trigger = line.triggers[0];
  const auto& region = line.regions[0];
  const auto& beyond = line.regions[1].present() ? line.regions[1] : line.regions[2];
  const bool at_third = trigger.presence == Presence::present &&
                        std::abs(scale.scaled(trigger.speed_ratio) - kNominalTrigger[0]) <= kSamePlace;
  std::vector<Finding> findings{
      {if_covered(region.presence, region.present() && region.aperiodic_share <= kPeriodicShare),
       region_text(1, region), "region 1 is periodic",
       region.present() ? fmt::format("{:.1f} %", 100.0 * region.aperiodic_share) : ""},
      {if_covered(trigger.presence, at_third), trigger_text(1, trigger), "trigger 1 at 1/3",
       place_text(trigger)}};
  if (region.present() && beyond.present()) {
    findings.push_back(
        {region.median_displacement <= kSmall * beyond.median_displacement,
         fmt::format("median displacement {} in region 1, {} in the region after it",
                     millimetres(region.median_displacement), millimetres(beyond.median_displacement)),
         "region 1 is small",
         fmt::format("{:.1e}", region.median_displacement / beyond.median_displacement)});
  }
  return findings;
}

std::vector<Finding> region_2_findings(const LineSummary& line, SpeedScale scale) {
  const auto& region = line.regions[1];
  std::vector<Finding> findings{{if_covered(region.presence, region.present()), region_text(2, region),
                                 "region 2 is there", brief_extent(region)}};
  if (!region.present()) return findings;
  findings.push_back({region.aperiodic_share < 1.0,
                      region.aperiodic_share < 1.0 ? "with periodic windows" : "without periodic windows",
                      "region 2 has periodic windows"});
  if (line.triggers[0].presence == Presence::present) {
    const double gap = scale.scaled(region.from - line.triggers[0].speed_ratio);
    findings.push_back({gap <= kNextTo, fmt::format("aperiodic motion begins {:.3f} above trigger 1", gap),
                        "region 2 begins at trigger 1", fmt::format("{:+.3f}", gap)});
  }
  return findings;
}

std::vector<Finding> region_3_findings(const LineSummary& line) {
  const auto& region = line.regions[2];
  return {{if_covered(region.presence, region.present() && region.aperiodic_share <= kPeriodicShare),
           region_text(3, region), "region 3 is there and periodic", brief_extent(region)}};
}

std::vector<Finding> region_4_findings(const LineSummary& line, SpeedScale scale, bool per_passing) {
  const auto& region = line.regions[3];
  std::vector<Finding> findings{{if_covered(region.presence, region.present()), region_text(4, region),
                                 "region 4 is there", brief_extent(region)}};
  if (region.presence == Presence::not_covered) return findings;
  const PeriodDoubling* nearest = nullptr;
  const auto distance = [&](const PeriodDoubling& doubling) {
    return std::abs(scale.scaled(doubling.speed_ratio) - kNominalTrigger[1]);
  };
  for (const auto& doubling : line.doublings) {
    if (distance(doubling) > kTriggerSearch) continue;
    if (nearest == nullptr || distance(doubling) < distance(*nearest)) nearest = &doubling;
  }
  const auto* map =
      per_passing ? "blade passings" : "revolutions (the atlas has no sections per blade passing)";
  if (nearest == nullptr) {
    findings.push_back(
        {false,
         fmt::format("no period doubling seen near 2/3 in {}, on speeds {:.4f} apart", map, line.speed_step),
         kDoubling});
    return findings;
  }
  findings.push_back(
      {distance(*nearest) <= kSamePlace,
       fmt::format("period {} doubles at {:.3f} in {}", nearest->from_period, nearest->speed_ratio, map),
       kDoubling, fmt::format("{:.3f}", nearest->speed_ratio)});
  if (region.present()) {
    const double gap = scale.scaled(region.from - nearest->speed_ratio);
    findings.push_back({gap >= -kSamePlace && gap <= kNextTo,
                        fmt::format("aperiodic motion begins {:.3f} above it", gap),
                        "aperiodic motion follows the doubling", fmt::format("{:+.3f}", gap)});
  }
  return findings;
}

}  // namespace

std::vector<Statement> judge_default_rotor(const Evidence& evidence) {
  std::vector<Statement> statements{{"P1", {}}, {"P2", {}}, {"P3", {}}, {"P4", {}}};
  const auto* line = evidence.own_line();
  if (line == nullptr) {
    const auto reason = evidence.other_rotor().empty() ? "the grid has no line of " + evidence.rotor().name
                                                       : evidence.other_rotor();
    for (auto& statement : statements) statement.findings.push_back({std::nullopt, reason});
    return statements;
  }
  statements[0].findings = region_1_findings(*line, evidence.scale());
  statements[1].findings = region_2_findings(*line, evidence.scale());
  statements[2].findings = region_3_findings(*line);
  statements[3].findings = region_4_findings(*line, evidence.scale(), evidence.per_passing());
  return statements;
}

}  // namespace rubatlas::analysis

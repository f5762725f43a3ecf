// P1 to P4 (MODEL 6.3): the four regions and two triggers of the default rotor.
#include <fmt/format.h>

#include <cmath>

#include "analysis/evidence_text.hpp"
#include "analysis/statements.hpp"

namespace rubatlas::analysis {
namespace {

std::optional<bool> if_covered(Presence presence, bool holds) {
  if (presence == Presence::not_covered) return std::nullopt;
  return holds;
}

std::vector<Finding> region_1_findings(const LineSummary& line, SpeedScale scale) {
  const auto& trigger = line.triggers[0];
  const auto& region = line.regions[0];
  const auto& beyond = line.regions[1].present() ? line.regions[1] : line.regions[2];
  const bool at_third = trigger.presence == Presence::present &&
                        std::abs(scale.scaled(trigger.speed_ratio) - kNominalTrigger[0]) <= kSamePlace;
  std::vector<Finding> findings{
      {if_covered(region.presence, region.present() && region.aperiodic_share <= kPeriodicShare),
       region_text(1, region)},
      {if_covered(trigger.presence, at_third), trigger_text(1, trigger)}};
  if (region.present() && beyond.present()) {
    findings.push_back(
        {region.median_displacement <= kSmall * beyond.median_displacement,
         fmt::format("median displacement {} in region 1, {} in the region after it",
                     millimetres(region.median_displacement), millimetres(beyond.median_displacement))});
  }
  return findings;
}

std::vector<Finding> region_2_findings(const LineSummary& line, SpeedScale scale) {
  const auto& region = line.regions[1];
  std::vector<Finding> findings{{if_covered(region.presence, region.present()), region_text(2, region)}};
  if (!region.present()) return findings;
  findings.push_back({region.aperiodic_share < 1.0,
                      region.aperiodic_share < 1.0 ? "with periodic windows" : "without periodic windows"});
  if (line.triggers[0].presence == Presence::present) {
    const double gap = scale.scaled(region.from - line.triggers[0].speed_ratio);
    findings.push_back({gap <= kNextTo, fmt::format("chaos begins {:.3f} above trigger 1", gap)});
  }
  return findings;
}

std::vector<Finding> region_3_findings(const LineSummary& line) {
  const auto& region = line.regions[2];
  return {{if_covered(region.presence, region.present() && region.aperiodic_share <= kPeriodicShare),
           region_text(3, region)}};
}

std::vector<Finding> region_4_findings(const LineSummary& line, SpeedScale scale, bool per_passing) {
  const auto& region = line.regions[3];
  std::vector<Finding> findings{{if_covered(region.presence, region.present()), region_text(4, region)}};
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
    findings.push_back({false, fmt::format("no period doubling seen near 2/3 in {}, on speeds {:.4f} apart",
                                           map, line.speed_step)});
    return findings;
  }
  findings.push_back(
      {distance(*nearest) <= kSamePlace,
       fmt::format("period {} doubles at {:.3f} in {}", nearest->from_period, nearest->speed_ratio, map)});
  if (region.present()) {
    const double gap = scale.scaled(region.from - nearest->speed_ratio);
    findings.push_back(
        {gap >= -kSamePlace && gap <= kNextTo, fmt::format("chaos begins {:.3f} above it", gap)});
  }
  return findings;
}

}  // namespace

std::vector<Statement> judge_default_rotor(const Evidence& evidence) {
  std::vector<Statement> statements{
      {"P1", "region 1, periodic with small displacement, up to Ω = 1/3, where the displacement rises", {}},
      {"P2", "then region 2, chaotic with periodic windows", {}},
      {"P3", "then region 3, periodic", {}},
      {"P4", "region 4, chaotic, entered by a period doubling at Ω = 2/3", {}}};
  const auto* line = evidence.default_line();
  if (line == nullptr) {
    const auto reason =
        evidence.other_rotor().empty() ? "the grid has no line of the default rotor" : evidence.other_rotor();
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

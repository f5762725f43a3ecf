// P12 (MODEL 6.3): the default rotor with another number of blades, its speeds scaled by n/3.
#include <fmt/format.h>

#include <cmath>

#include "analysis/paper/findings_along.hpp"
#include "analysis/paper/statements.hpp"
#include "analysis/rules/evidence_text.hpp"

namespace rubatlas::analysis {

Statement judge_blade_count(const Evidence& evidence) {
  Statement statement{"P12", {}};
  const int count = evidence.scene().blades.count;
  const auto* line = evidence.own_line();
  if (!evidence.other_rotor().empty()) {
    statement.findings.push_back(not_covered(evidence.other_rotor()));
  } else if (count == 3) {
    statement.findings.push_back(not_covered("the rotor has the three blades of the default rotor"));
  } else if (line == nullptr) {
    statement.findings.push_back(not_covered("the grid has no line of " + evidence.rotor().name));
  } else {
    for (const std::size_t which : {0U, 1U}) {
      statement.findings.push_back(trigger_at_its_place(*line, evidence.scale(), which));
    }
    for (std::size_t i = 0; i < line->regions.size(); ++i) {
      const auto& region = line->regions[i];
      const auto claim = fmt::format("region {} is there", i + 1);
      const auto text = region_text(static_cast<int>(i) + 1, region);
      if (region.presence == Presence::not_covered) {
        statement.findings.push_back(not_covered(text, claim));
      } else {
        statement.findings.push_back({region.present(), text, claim});
      }
    }
  }
  return statement;
}

}  // namespace rubatlas::analysis

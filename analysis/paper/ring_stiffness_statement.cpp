// P13 (MODEL 6.3): rigid blades on an elastic ring show the global picture, along the ring's stiffness.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analysis/paper/findings_along.hpp"
#include "analysis/paper/statements.hpp"

namespace rubatlas::analysis {

Statement judge_ring_stiffness(const Evidence& evidence) {
  const std::string_view name = "ring_stiffness";
  Statement statement{"P13", {}};
  const auto lines = evidence.lines_along(name);
  if (!evidence.other_rotor().empty()) {
    statement.findings.push_back(not_covered(evidence.other_rotor()));
    return statement;
  }
  if (evidence.scene().contact.law != settings::ContactLaw::elastic_ring || lines.size() < 2) {
    statement.findings.push_back(
        not_covered("the grid has no axis /ring/stiffness under the law elastic_ring"));
    return statement;
  }
  std::vector<std::string> complete;
  bool known = true;
  for (const auto* line : lines) {
    for (const auto& region : line->regions) known = known && region.presence != Presence::not_covered;
    if (has_all_four(*line)) complete.push_back(evidence.value_text(*line, name));
  }
  const std::string_view some = "all four regions at some stiffness";
  if (complete.empty() && !known) {
    statement.findings.push_back(not_covered("not all regions are covered on every line", std::string(some)));
  } else {
    statement.findings.push_back({!complete.empty(),
                                  complete.empty()
                                      ? "nowhere all four regions"
                                      : fmt::format("all four regions at {}", fmt::join(complete, ", ")),
                                  std::string(some), fmt::format("{}/{}", complete.size(), lines.size())});
  }
  statement.findings.push_back(all_four(evidence, lines, name, "all four regions at every stiffness"));
  for (const std::size_t which : {0U, 1U}) {
    statement.findings.push_back(trigger_on_every(evidence, lines, name, which, "stiffness"));
  }
  return statement;
}

}  // namespace rubatlas::analysis

// P8 (MODEL 6.3): how unbalance changes the regions and triggers of the default rotor.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "analysis/paper/findings_along.hpp"
#include "analysis/rules/evidence_text.hpp"

namespace rubatlas::analysis {
namespace {

constexpr double kSmallUnbalance = 1e-5;     ///< [kg m] the largest of the paper's values that count as small
constexpr double kGreatestUnbalance = 1e-4;  ///< [kg m] the paper's largest value
constexpr const char* kAperiodic = "growing me makes region 3 aperiodic";
constexpr const char* kStays = "trigger 1 stays at every me";

/// A region that is known to be absent cannot become aperiodic.
std::optional<bool> if_known(const Region& region) {
  if (region.presence == Presence::not_covered) return std::nullopt;
  return false;
}

}  // namespace

std::vector<Finding> unbalance_findings(const Evidence& evidence) {
  const std::string_view name = "unbalance";
  const auto lines = evidence.lines_along(name);
  if (const auto reason = no_lines(evidence, lines, name); !reason.empty()) return {not_covered(reason)};
  const auto small = within(evidence, lines, name, 0.0, kSmallUnbalance);
  const auto paper = within(evidence, lines, name, 0.0, kGreatestUnbalance);
  std::vector<Finding> findings;
  if (!small.empty()) findings.push_back(all_four(evidence, small, name, "four regions for me ≤ 1e-5"));

  // "Growing it": a property that the line of the least unbalance does not have, and a line within the
  // paper's range has.
  const auto growth = [&](std::string_view what, std::string claim, const auto& shows) {
    const auto knows = [&](const LineSummary* line) { return shows(*line).has_value(); };
    if (paper.size() < 2 || !std::ranges::all_of(paper, knows)) {
      findings.push_back(
          not_covered(fmt::format("{}: not known for every unbalance up to 1e-4 kg m", what), claim));
      return;
    }
    const auto first = std::ranges::find_if(lines, [&](const auto* l) { return shows(*l).value_or(false); });
    const bool already = first == lines.begin();
    const bool never = first == lines.end();
    const bool in_range = !never && evidence.value(**first, name) <= kGreatestUnbalance * kRounding;
    findings.push_back({in_range && !already,
                        never ? fmt::format("{}: never", what)
                              : fmt::format("{}: {} {}", what, already ? "already at" : "from",
                                            evidence.value_text(**first, name)),
                        std::move(claim),
                        never ? "never" : fmt::format("{:.0e}", evidence.value(**first, name))});
  };
  using Known = std::optional<bool>;
  growth("no trigger 2", "growing me removes trigger 2", [](const LineSummary& line) -> Known {
    if (line.triggers[1].presence == Presence::not_covered) return std::nullopt;
    return line.triggers[1].presence == Presence::absent;
  });
  const auto& place = lines.front()->regions[2];
  if (place.present()) {
    const auto where = fmt::format("aperiodic in most of {}, region 3 at {}", extent_text(place),
                                   evidence.value_text(*lines.front(), name));
    growth(where, kAperiodic, [&](const LineSummary& line) -> Known {
      const double share = aperiodic_share(line.line, place.from, place.to);
      if (std::isnan(share)) return std::nullopt;
      return share >= kAperiodicMajority;
    });
  } else {
    findings.push_back({if_known(place), region_text(3, place), kAperiodic});
  }
  growth("regions 2, 3 and 4 merged", "growing me merges 2, 3 and 4", [](const LineSummary& line) -> Known {
    if (line.regions[3].presence == Presence::not_covered) return std::nullopt;
    return line.regions[3].presence == Presence::merged;
  });

  // "Always": at every unbalance of the paper's range; departures beyond the range are reported.
  std::vector<std::string> without;
  std::vector<std::string> beyond;
  bool known = true;
  for (const auto* line : lines) {
    const bool in_range = evidence.value(*line, name) <= kGreatestUnbalance * kRounding;
    const auto presence = line->triggers[0].presence;
    known = known && (!in_range || presence != Presence::not_covered);
    if (presence == Presence::absent) {
      (in_range ? without : beyond).push_back(evidence.value_text(*line, name));
    }
  }
  const auto after = beyond.empty() ? "" : fmt::format(" (beyond: none at {})", fmt::join(beyond, ", "));
  if (!known) {
    findings.push_back(not_covered("trigger 1: the lines do not reach over it", kStays));
  } else if (without.empty()) {
    findings.push_back({true, "trigger 1 on every line up to 1e-4 kg m" + after, kStays});
  } else {
    findings.push_back({false, fmt::format("no trigger 1 at {}{}", fmt::join(without, ", "), after), kStays});
  }
  return findings;
}

}  // namespace rubatlas::analysis

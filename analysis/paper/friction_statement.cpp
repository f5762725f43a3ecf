// P7 (MODEL 6.3): how friction changes the regions of the default rotor.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "analysis/paper/findings_along.hpp"

namespace rubatlas::analysis {
namespace {

/// Friction coefficients between which the paper finds chaos in region 1.
constexpr double kLeastChaoticFriction = 0.01;
constexpr double kGreatestChaoticFriction = 0.2;

/// Largest shift of a border of a region from line to line, in scaled speed.
double largest_shift(const Lines& lines, SpeedScale scale) {
  double largest = 0.0;
  for (std::size_t which = 0; which < 4; ++which) {
    for (double Region::*border : {&Region::from, &Region::to}) {
      const auto place = [&](const LineSummary* line) { return line->regions[which].*border; };
      const auto [low, high] = std::ranges::minmax(lines, {}, place);
      largest = std::max(largest, scale.scaled(place(high) - place(low)));
    }
  }
  return largest;
}

}  // namespace

std::vector<Finding> friction_findings(const Evidence& evidence) {
  const std::string_view name = "friction";
  const auto lines = evidence.lines_along(name);
  if (const auto reason = no_lines(evidence, lines, name); !reason.empty()) return {not_covered(reason)};
  std::vector<Finding> findings{all_four(evidence, lines, name, "all four regions at every μ")};
  if (findings.front().holds == true) {
    const double shift = largest_shift(lines, evidence.scale());
    findings.push_back({shift <= kNextTo, fmt::format("borders of the regions move by up to {:.3f}", shift),
                        "μ moves borders only locally", fmt::format("{:.3f}", shift)});
  }
  const auto judge = [&](const Lines& some, bool expected, std::string_view where) {
    if (some.empty()) return;
    std::vector<std::string> shares;
    bool holds = true;
    bool known = true;
    for (const auto* line : some) {
      const double share = line->regions[0].aperiodic_share;
      known = known && std::isfinite(share);
      holds = holds && (share > 0.0) == expected;
      shares.push_back(fmt::format("{:.1f} % at {}", 100.0 * share, evidence.value_text(*line, name)));
    }
    const auto claim = fmt::format("{}aperiodic points in region 1 {}", expected ? "" : "no ", where);
    if (!known) {
      findings.push_back(not_covered(
          fmt::format("aperiodic points in region 1 {}: no region 1 on every line", where), claim));
    } else {
      findings.push_back(
          {holds, fmt::format("aperiodic points in region 1 {}: {}", where, fmt::join(shares, ", ")), claim});
    }
  };
  const auto inside = within(evidence, lines, name, kLeastChaoticFriction, kGreatestChaoticFriction);
  Lines outside;
  std::ranges::copy_if(lines, std::back_inserter(outside), [&](const LineSummary* line) {
    return std::ranges::find(inside, line) == inside.end();
  });
  judge(inside, true, "for μ in [0.01, 0.2]");
  judge(outside, false, "elsewhere");
  return findings;
}

}  // namespace rubatlas::analysis

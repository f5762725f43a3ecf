// P5 and P6 (MODEL 6.3): how damping changes the regions of the default rotor.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "analysis/paper/findings_along.hpp"
#include "analysis/rules/evidence_text.hpp"
#include "analysis/rules/sensitivity.hpp"

namespace rubatlas::analysis {
namespace {

/// The paper's "global picture" is for damping ratios up to this.
constexpr double kGlobalPictureDamping = 0.15;
/// More aperiodic points in region 1, as a share, that make "small chaotic areas".
constexpr double kSmallArea = 0.01;

/// One number of a line, set against that of a reference line.
struct Comparison {
  std::string what;
  std::string claim;
  std::function<double(const LineSummary&)> value;
  double sign;        ///< +1: it should be greater than on the reference line, -1: smaller
  double noticeable;  ///< by this at least
  bool in_percent = false;
};

/// Judged on the first of `candidates` on which the number is known, since the width of a region that ends at
/// a gap is unknown.
Finding compared(const Evidence& evidence, std::string_view name, const Lines& candidates,
                 const LineSummary& reference, const Comparison& comparison) {
  const auto known = std::ranges::find_if(
      candidates, [&](const LineSummary* line) { return std::isfinite(comparison.value(*line)); });
  const double there = comparison.value(reference);
  if (known == candidates.end() || !std::isfinite(there)) {
    return not_covered(fmt::format("{}: not known on two lines", comparison.what), comparison.claim);
  }
  const auto number = [&](double value) {
    return comparison.in_percent ? fmt::format("{:.0f} %", 100.0 * value) : fmt::format("{:.3f}", value);
  };
  const double here = comparison.value(**known);
  return {
      comparison.sign * (here - there) >= comparison.noticeable,
      fmt::format("{}: {} at {}, {} at {}", comparison.what, number(here), evidence.value_text(**known, name),
                  number(there), evidence.value_text(reference, name)),
      comparison.claim, fmt::format("{} / {}", number(here), number(there))};
}

/// Extent of the aperiodic motion in a region: width times share [-]; 0 where the region is absent, NaN where
/// not known.
double aperiodic_extent(const Region& region) {
  return region.present() ? region.width() * region.aperiodic_share : region.width();
}

/// The line that low and high damping are compared with: the default one, else the highest within the paper's
/// range.
const LineSummary* reference_damping(const Evidence& evidence, const Lines& lines) {
  if (const auto* line = evidence.own_line()) return line;
  const auto inside = within(evidence, lines, "damping_ratio", 0.0, kGlobalPictureDamping);
  return inside.empty() ? nullptr : inside.back();
}

}  // namespace

std::vector<Finding> low_damping_findings(const Evidence& evidence) {
  const std::string_view name = "damping_ratio";
  const auto lines = evidence.lines_along(name);
  if (const auto reason = no_lines(evidence, lines, name); !reason.empty()) return {not_covered(reason)};
  const auto inside = within(evidence, lines, name, 0.0, kGlobalPictureDamping);
  const auto* reference = reference_damping(evidence, lines);
  if (inside.empty() || reference == nullptr) return {not_covered("no damping ratio up to 0.15")};

  std::vector<Finding> findings{all_four(evidence, inside, name, "all four regions for ζ ≤ 0.15")};
  Lines lower;
  std::ranges::copy_if(inside, std::back_inserter(lower), [&](const LineSummary* line) {
    return evidence.value(*line, name) < evidence.value(*reference, name);
  });
  if (lower.empty()) {
    findings.push_back(not_covered("no damping ratio below that of the default rotor"));
    return findings;
  }
  const double step = evidence.scale().speed_ratio(kNoticeableWidth);
  const auto width = [](std::size_t which) {
    return [which](const LineSummary& line) { return line.regions[which].width(); };
  };
  const auto share = [](const LineSummary& line) { return line.regions[0].aperiodic_share; };
  findings.push_back(compared(evidence, name, lower, *reference,
                              {"width of region 2", "low ζ widens region 2", width(1), 1.0, step}));
  findings.push_back(compared(evidence, name, lower, *reference,
                              {"width of region 3", "low ζ shortens region 3", width(2), -1.0, step}));
  findings.push_back(compared(evidence, name, lower, *reference,
                              {"aperiodic share of region 1", "low ζ: small aperiodic areas in region 1",
                               share, 1.0, kSmallArea, true}));
  return findings;
}

std::vector<Finding> high_damping_findings(const Evidence& evidence) {
  const std::string_view name = "damping_ratio";
  const auto lines = evidence.lines_along(name);
  if (const auto reason = no_lines(evidence, lines, name); !reason.empty()) return {not_covered(reason)};
  const auto* reference = reference_damping(evidence, lines);
  const auto& high = *lines.back();
  if (reference == nullptr || evidence.value(high, name) <= kGlobalPictureDamping * kRounding) {
    return {not_covered("no damping ratio above 0.15")};
  }
  std::vector<Finding> findings;
  for (const std::size_t which : {1U, 3U}) {
    const auto extent = [which](const LineSummary& line) { return aperiodic_extent(line.regions[which]); };
    findings.push_back(compared(evidence, name, {&high}, *reference,
                                {fmt::format("aperiodic part of region {} (width × share)", which + 1),
                                 fmt::format("high ζ attenuates region {}", which + 1), extent, -1.0,
                                 evidence.scale().speed_ratio(kNoticeableWidth)}));
    // A region can disappear only if it exists on the line with which high damping is compared.
    const auto presence = high.regions[which].presence;
    const auto before = reference->regions[which].presence;
    std::optional<bool> gone;
    if (presence != Presence::not_covered && before != Presence::not_covered) {
      gone = presence == Presence::absent && before != Presence::absent;
    }
    findings.push_back(
        {gone,
         fmt::format("{} at {}, {} at {}", region_text(static_cast<int>(which) + 1, high.regions[which]),
                     evidence.value_text(high, name), before == Presence::absent ? "absent already" : "there",
                     evidence.value_text(*reference, name)),
         fmt::format("high ζ: region {} disappears", which + 1)});
  }
  return findings;
}

}  // namespace rubatlas::analysis

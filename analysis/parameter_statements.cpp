// P5 to P8 (MODEL 6.3): what damping, friction and unbalance do to the regions of the default rotor.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "analysis/evidence_text.hpp"
#include "analysis/sensitivity.hpp"
#include "analysis/statements.hpp"

namespace rubatlas::analysis {
namespace {

using Lines = std::vector<const LineSummary*>;

/// The statement's own limits, from the paper.
constexpr double kGlobalPictureDamping = 0.15;
constexpr double kLeastChaoticFriction = 0.01;
constexpr double kGreatestChaoticFriction = 0.2;
constexpr double kSmallUnbalance = 1e-5;     ///< [kg m] of the paper's five values the small ones
constexpr double kGreatestUnbalance = 1e-4;  ///< [kg m] the paper's largest value
/// More aperiodic points in region 1, as a share, that make "small chaotic areas".
constexpr double kSmallArea = 0.01;
/// Decimals as binary64.
constexpr double kRounding = 1.0 + 1e-9;

Finding not_covered(std::string reason) {
  return {std::nullopt, std::move(reason)};
}

/// Why no line can be judged along a parameter; empty when there are at least two.
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

/// One number of a line, set against that of a reference line.
struct Comparison {
  std::string what;
  std::function<double(const LineSummary&)> value;
  double sign;        ///< +1: it should be greater than on the reference line, -1: smaller
  double noticeable;  ///< by this at least
  bool in_percent = false;
};

/// Judged on the first of `candidates` on which the number is known: a region that ends at a gap has no
/// width.
Finding compared(const Evidence& evidence, std::string_view name, const Lines& candidates,
                 const LineSummary& reference, const Comparison& comparison) {
  const auto known = std::ranges::find_if(
      candidates, [&](const LineSummary* line) { return std::isfinite(comparison.value(*line)); });
  const double there = comparison.value(reference);
  if (known == candidates.end() || !std::isfinite(there)) {
    return not_covered(fmt::format("{}: not known on two lines", comparison.what));
  }
  const auto number = [&](double value) {
    return comparison.in_percent ? fmt::format("{:.0f} %", 100.0 * value) : fmt::format("{:.3f}", value);
  };
  const double here = comparison.value(**known);
  return {
      comparison.sign * (here - there) >= comparison.noticeable,
      fmt::format("{}: {} at {}, {} at {}", comparison.what, number(here), evidence.value_text(**known, name),
                  number(there), evidence.value_text(reference, name))};
}

/// Extent of the chaos in a region: width times share [-]; 0 where the region is absent, NaN where not known.
double chaos(const Region& region) {
  return region.present() ? region.width() * region.aperiodic_share : region.width();
}

/// The line that low and high damping are compared with: the default one, else the highest within the paper's
/// range.
const LineSummary* reference_damping(const Evidence& evidence, const Lines& lines) {
  if (const auto* line = evidence.default_line()) return line;
  const auto inside = within(evidence, lines, "damping_ratio", 0.0, kGlobalPictureDamping);
  return inside.empty() ? nullptr : inside.back();
}

std::vector<Finding> low_damping_findings(const Evidence& evidence) {
  const std::string_view name = "damping_ratio";
  const auto lines = evidence.lines_along(name);
  if (const auto reason = no_lines(evidence, lines, name); !reason.empty()) return {not_covered(reason)};
  const auto inside = within(evidence, lines, name, 0.0, kGlobalPictureDamping);
  const auto* reference = reference_damping(evidence, lines);
  if (inside.empty() || reference == nullptr) return {not_covered("no damping ratio up to 0.15")};

  std::vector<Finding> findings{all_four(evidence, inside, name)};
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
  findings.push_back(compared(evidence, name, lower, *reference, {"width of region 2", width(1), 1.0, step}));
  findings.push_back(
      compared(evidence, name, lower, *reference, {"width of region 3", width(2), -1.0, step}));
  findings.push_back(compared(evidence, name, lower, *reference,
                              {"aperiodic share of region 1", share, 1.0, kSmallArea, true}));
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
    const auto extent = [which](const LineSummary& line) { return chaos(line.regions[which]); };
    findings.push_back(compared(evidence, name, {&high}, *reference,
                                {fmt::format("chaos of region {} (width × share)", which + 1), extent, -1.0,
                                 evidence.scale().speed_ratio(kNoticeableWidth)}));
    const auto presence = high.regions[which].presence;
    const std::optional<bool> gone = presence == Presence::not_covered
                                         ? std::optional<bool>{}
                                         : std::optional<bool>{presence == Presence::absent};
    findings.push_back(
        {gone, fmt::format("{} at {}", region_text(static_cast<int>(which) + 1, high.regions[which]),
                           evidence.value_text(high, name))});
  }
  return findings;
}

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

std::vector<Finding> friction_findings(const Evidence& evidence) {
  const std::string_view name = "friction";
  const auto lines = evidence.lines_along(name);
  if (const auto reason = no_lines(evidence, lines, name); !reason.empty()) return {not_covered(reason)};
  std::vector<Finding> findings{all_four(evidence, lines, name)};
  if (findings.front().holds == true) {
    const double shift = largest_shift(lines, evidence.scale());
    findings.push_back({shift <= kNextTo, fmt::format("borders of the regions move by up to {:.3f}", shift)});
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
    if (!known) {
      findings.push_back(not_covered(fmt::format("chaos in region 1 {}: no region 1 on every line", where)));
    } else {
      findings.push_back({holds, fmt::format("chaos in region 1 {}: {}", where, fmt::join(shares, ", "))});
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

/// A region that is known not to be there cannot become chaotic.
std::optional<bool> if_known(const Region& region) {
  if (region.presence == Presence::not_covered) return std::nullopt;
  return false;
}

std::vector<Finding> unbalance_findings(const Evidence& evidence) {
  const std::string_view name = "unbalance";
  const auto lines = evidence.lines_along(name);
  if (const auto reason = no_lines(evidence, lines, name); !reason.empty()) return {not_covered(reason)};
  const auto small = within(evidence, lines, name, 0.0, kSmallUnbalance);
  const auto paper = within(evidence, lines, name, 0.0, kGreatestUnbalance);
  std::vector<Finding> findings;
  if (!small.empty()) findings.push_back(all_four(evidence, small, name));

  // "Growing it": what the least unbalance of the atlas has not, and one within the paper's range has.
  const auto growth = [&](std::string_view what, const auto& shows) {
    const auto knows = [&](const LineSummary* line) { return shows(*line).has_value(); };
    if (paper.size() < 2 || !std::ranges::all_of(paper, knows)) {
      findings.push_back(not_covered(fmt::format("{}: not known for every unbalance up to 1e-4 kg m", what)));
      return;
    }
    const auto first = std::ranges::find_if(lines, [&](const auto* l) { return shows(*l).value_or(false); });
    const bool already = first == lines.begin();
    const bool never = first == lines.end();
    const bool in_range = !never && evidence.value(**first, name) <= kGreatestUnbalance * kRounding;
    findings.push_back(
        {in_range && !already, never ? fmt::format("{}: never", what)
                                     : fmt::format("{}: {} {}", what, already ? "already at" : "from",
                                                   evidence.value_text(**first, name))});
  };
  using Known = std::optional<bool>;
  growth("no trigger 2", [](const LineSummary& line) -> Known {
    if (line.triggers[1].presence == Presence::not_covered) return std::nullopt;
    return line.triggers[1].presence == Presence::absent;
  });
  const auto& place = lines.front()->regions[2];
  if (place.present()) {
    const auto where = fmt::format("chaos in most of {}, region 3 at {}", extent_text(place),
                                   evidence.value_text(*lines.front(), name));
    growth(where, [&](const LineSummary& line) -> Known {
      const double share = aperiodic_share(line.line, place.from, place.to);
      if (std::isnan(share)) return std::nullopt;
      return share >= kChaoticShare;
    });
  } else {
    findings.push_back({if_known(place), region_text(3, place)});
  }
  growth("regions 2, 3 and 4 merged", [](const LineSummary& line) -> Known {
    if (line.regions[3].presence == Presence::not_covered) return std::nullopt;
    return line.regions[3].presence == Presence::merged;
  });

  std::vector<std::string> without;
  bool known = true;
  for (const auto* line : lines) {
    known = known && line->triggers[0].presence != Presence::not_covered;
    if (line->triggers[0].presence == Presence::absent) without.push_back(evidence.value_text(*line, name));
  }
  if (!known) {
    findings.push_back(not_covered("trigger 1: the lines do not reach over it"));
  } else if (without.empty()) {
    findings.push_back({true, "trigger 1 on every line"});
  } else {
    findings.push_back({false, fmt::format("no trigger 1 at {}", fmt::join(without, ", "))});
  }
  return findings;
}

}  // namespace

std::vector<Statement> judge_parameters(const Evidence& evidence) {
  return {
      {"P5",
       "the global picture holds for ζ ≤ 0.15; low damping widens region 2, shortens region 3 and opens "
       "small "
       "chaotic areas in region 1",
       low_damping_findings(evidence)},
      {"P6", "high damping attenuates regions 2 and 4 until they disappear", high_damping_findings(evidence)},
      {"P7", "friction changes things only locally; chaos appears in region 1 for 0.01 ≤ μ ≤ 0.2",
       friction_findings(evidence)},
      {"P8",
       "small unbalance keeps the four regions; growing it (up to 1e-4 kg m) removes the trigger at 2/3, "
       "makes "
       "region 3 chaotic and merges 2, 3 and 4; the trigger at 1/3 always stays",
       unbalance_findings(evidence)}};
}

}  // namespace rubatlas::analysis

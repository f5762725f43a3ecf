/// Findings along one parameter: the lines, and the regions and triggers that they lack.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/paper/statements.hpp"
#include "analysis/rules/line_summary.hpp"

namespace rubatlas::analysis {

/// Lines along one parameter, ascending in it.
using Lines = std::vector<const LineSummary*>;

/// A finding without a value.
Finding not_covered(std::string reason, std::string claim = {});

/// The lines with all four regions.
[[nodiscard]] bool has_all_four(const LineSummary& line);

/// The reason why no finding along a parameter is possible; empty when there are at least two lines.
std::string no_lines(const Evidence& evidence, const Lines& lines, std::string_view name);

/// The lines whose parameter is in [low, high], to within the rounding of decimals.
Lines within(const Evidence& evidence, const Lines& lines, std::string_view name, double low, double high);

/// Whether all four regions exist on each of the lines: false where one is known to be absent, not covered
/// where one might lie among points that are not done.
Finding all_four(const Evidence& evidence, const Lines& lines, std::string_view name, std::string claim);

/// Whether every line has a trigger within `kSamePlace` of 1/n (2/n); `of` names the lines.
Finding trigger_on_every(const Evidence& evidence, const Lines& lines, std::string_view name,
                         std::size_t which, std::string_view of);
/// The trigger of one line at 1/n (2/n).
Finding trigger_at_its_place(const LineSummary& line, SpeedScale scale, std::size_t which);

/// Limits and values are decimals stored as binary64; a limit is widened by this factor.
constexpr double kRounding = 1.0 + 1e-9;

/// P5 and P6: findings along the damping ratio.
std::vector<Finding> low_damping_findings(const Evidence& evidence);
std::vector<Finding> high_damping_findings(const Evidence& evidence);
/// P7: findings along friction.
std::vector<Finding> friction_findings(const Evidence& evidence);
/// P8: findings along the unbalance.
std::vector<Finding> unbalance_findings(const Evidence& evidence);

}  // namespace rubatlas::analysis

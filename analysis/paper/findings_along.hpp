/// Findings along one parameter: which lines there are, and what they lack.
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

/// Lines on which all four regions are.
[[nodiscard]] bool has_all_four(const LineSummary& line);

/// Why no line can be judged along a parameter; empty when there are at least two.
std::string no_lines(const Evidence& evidence, const Lines& lines, std::string_view name);

/// The lines whose parameter is in [low, high], to within the rounding of decimals.
Lines within(const Evidence& evidence, const Lines& lines, std::string_view name, double low, double high);

/// All four regions on each of the lines: false where one is known not to be there, not covered where one
/// might be where the points are not done.
Finding all_four(const Evidence& evidence, const Lines& lines, std::string_view name, std::string claim);

/// A trigger on every one of the lines, each within `kSamePlace` of its place (1/n, 2/n); `of` says which
/// lines they are.
Finding trigger_on_every(const Evidence& evidence, const Lines& lines, std::string_view name,
                         std::size_t which, std::string_view of);
/// The trigger of one line at 1/n (2/n).
Finding trigger_at_its_place(const LineSummary& line, SpeedScale scale, std::size_t which);

/// Limits and values are decimals as binary64: a limit is stretched by this factor.
constexpr double kRounding = 1.0 + 1e-9;

/// P5 and P6, along the damping ratio.
std::vector<Finding> low_damping_findings(const Evidence& evidence);
std::vector<Finding> high_damping_findings(const Evidence& evidence);
/// P7, along friction.
std::vector<Finding> friction_findings(const Evidence& evidence);
/// P8, along the unbalance.
std::vector<Finding> unbalance_findings(const Evidence& evidence);

}  // namespace rubatlas::analysis

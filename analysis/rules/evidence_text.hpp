/// Texts on regions, triggers and edges.
#pragma once

#include <string>

#include "analysis/rules/regions.hpp"
#include "analysis/rules/triggers.hpp"

namespace rubatlas::analysis {

/// A speed that lies between two: "0.4393415(5)", with the uncertainty of the last digit in parentheses.
std::string speed_text(const Interval& between);
/// "0.352-0.598"; an end at a gap of the line, where the region may go on, in parentheses: "0.352-(0.454)".
/// An end that has been narrowed down has its uncertainty: "0.4393415(5)-0.598".
std::string extent_text(const Region& region);
/// "region 2: 0.352-0.598, 87 % aperiodic, peak 15.4 mm", or "region 2: absent".
std::string region_text(int number, const Region& region);
/// "trigger 1: at 0.331, 0.1 mm to 3.2 mm (×32)", or "trigger 1: absent".
std::string trigger_text(int number, const Trigger& trigger);

}  // namespace rubatlas::analysis

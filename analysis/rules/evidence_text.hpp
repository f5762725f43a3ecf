/// Texts on regions and edges.
#pragma once

#include <string>

#include "analysis/rules/regions.hpp"

namespace rubatlas::analysis {

/// A speed that lies between two: "0.4393415(5)", with the uncertainty of the last digit in parentheses.
std::string speed_text(const Interval& between);
/// "0.352-0.598"; an end at a gap or at the end of the line, where the region may go on, in parentheses:
/// "0.352-(0.454)".
/// An end that has been narrowed down has its uncertainty: "0.4393415(5)-0.598".
std::string extent_text(const Region& region);

}  // namespace rubatlas::analysis

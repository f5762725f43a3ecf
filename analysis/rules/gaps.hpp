/// Gaps of a line: stretches whose points are not done, because they are pending or the motion left the
/// model's validity there. What lies on the two sides of a gap is judged apart, and a region that ends at one
/// is open.
#pragma once

#include <cstddef>

#include "analysis/rules/line.hpp"

namespace rubatlas::analysis {

/// Scaled length up to which missing points are none to speak of: half a running window (regions.hpp).
constexpr double kLongestHole = 1.0 / 40.0;

[[nodiscard]] bool is_done(const Line& line, std::size_t point);
/// True when the points right above (below) `point` are not done, over more than the longest hole.
[[nodiscard]] bool gap_above(const Line& line, SpeedScale scale, std::size_t point);
[[nodiscard]] bool gap_below(const Line& line, SpeedScale scale, std::size_t point);

}  // namespace rubatlas::analysis

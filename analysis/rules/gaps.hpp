/// Gaps of a line: stretches whose points are not done, because they are pending or the motion left the
/// model's validity there. The two sides of a gap are judged separately, and a region that ends at a gap is
/// open.
#pragma once

#include <cstddef>

#include "analysis/rules/line.hpp"

namespace rubatlas::analysis {

/// Missing points over less than this scaled length make no gap: half a running window (regions.hpp).
constexpr double kLongestHole = 1.0 / 40.0;

[[nodiscard]] bool is_done(const Line& line, std::size_t point);
/// True when the points right above (below) `point` are not done, over more than the longest hole.
[[nodiscard]] bool gap_above(const Line& line, SpeedScale scale, std::size_t point);
[[nodiscard]] bool gap_below(const Line& line, SpeedScale scale, std::size_t point);

}  // namespace rubatlas::analysis

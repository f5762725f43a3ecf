/// How far every point of an atlas is from a change, in each parameter that is swept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "analysis/rules/line_summary.hpp"
#include "analysis/rules/margins.hpp"
#include "plan/grid.hpp"

namespace rubatlas::analysis {

/// Distances along one axis, one per point of the atlas, in units of the axis.
struct AxisMargins {
  std::size_t axis = 0;
  std::vector<double> to_border;   ///< to the nearest border; NaN where there is none
  std::vector<double> to_grazing;  ///< to the predicted grazing, with its sign; NaN where none is predicted
};

/// A border along Ω at which the motion is predicted to graze.
struct GrazingBorder {
  std::size_t line = 0;
  Border border;
  Grazing grazing;
  std::uint8_t side = 0;  ///< on which the tip passes the ring, as in `/grazing_side`; 0 where not known
};

struct Margins {
  std::vector<AxisMargins> axes;
  std::vector<GrazingBorder> grazings;  ///< ascending in line and Ω
};

/// What the margins are found from; one entry per point of the atlas in each.
struct MarginRows {
  std::vector<std::uint8_t> motion;     ///< classes, as `border_motions` has them
  std::vector<double> nearest_miss;     ///< [m]; NaN where no tip passes the ring; empty where it is not kept
  std::vector<std::uint8_t> miss_side;  ///< side of the nearest miss; 0 where not known; empty where not kept
};

/// `lines` are those of the atlas, with their regions.
[[nodiscard]] Margins find_margins(std::span<const plan::Axis> axes, const MarginRows& rows,
                                   std::span<const LineSummary> lines);

}  // namespace rubatlas::analysis

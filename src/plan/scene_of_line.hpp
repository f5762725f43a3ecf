/// The scene of one line, which everything that computes the line reads.
#pragma once

#include "plan/grid.hpp"
#include "settings/scene.hpp"

namespace rubatlas::plan {

/// `scene` with the line's value of every swept quantity (all axes but the speed ratio, which varies along
/// the line) written into its place; the grid stays. An unbalance of zero is the absent effect. Throws
/// std::invalid_argument where `line.swept` has not one value for each axis of `scene.grid.swept`.
settings::Scene scene_of_line(const settings::Scene& scene, const PointParameters& line);

/// `scene` with one value on each axis of its grid, of which `scene_of_line` makes the scenes of the same
/// lines, but for their grid. The axes of a large atlas are too long to be copied for each of its lines.
settings::Scene with_short_axes(settings::Scene scene);

}  // namespace rubatlas::plan

/// The state from which a point starts that goes on from no other.
#pragma once

#include "motion/point_start.hpp"
#include "plan/grid.hpp"
#include "settings/scene.hpp"

namespace rubatlas::assembly {

/// The scene's `initial`, with the point's own values of those of its quantities that are axes of the grid.
motion::SectionState initial_state(const settings::Scene& scene, const plan::PointParameters& point);

}  // namespace rubatlas::assembly

/// From a scene to the solver of one of its lines, and to where its points start: the one door to the
/// physics.
#pragma once

#include <memory>

#include "motion/point_start.hpp"
#include "plan/grid.hpp"
#include "point/line_solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::assembly {

/// Blade tables, one per friction coefficient, made on first use and shared by all lines of a rank.
class BladeTables;
std::shared_ptr<BladeTables> make_blade_tables();

/// `line` gives damping ratio, friction, unbalance and thickness; its speed ratio is not read.
std::unique_ptr<point::LineSolver> make_line_solver(const settings::Scene& scene,
                                                    const plan::PointParameters& line,
                                                    const std::shared_ptr<BladeTables>& tables);

/// The state from which a point starts that goes on from no other: the scene's `initial`, with the point's
/// own values of those of its quantities that are axes of the grid.
motion::SectionState initial_state(const settings::Scene& scene, const plan::PointParameters& point);

}  // namespace rubatlas::assembly

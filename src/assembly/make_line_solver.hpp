/// From a scene to the solver of one of its lines: the one door to the physics.
#pragma once

#include <memory>

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

/// Whether the method `collocation` applies to a scene of one line: not to columns on dampers, nor to blades
/// whose bends no table holds, which are computed as by `hybrid`.
bool collocates(const settings::Scene& line);

}  // namespace rubatlas::assembly

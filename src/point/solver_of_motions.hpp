/// The solver of a line from what makes its motions, for those who make motions and solve nothing.
#pragma once

#include <memory>

#include "motion/point_motion.hpp"
#include "point/solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::point {

/// `line`: the scene with the line's values of all that is swept; `make` makes its motions.
std::unique_ptr<LineSolver> solver_of_motions(const settings::Scene& line, motion::MakeMotion make);

}  // namespace rubatlas::point

/// The cost of a right-hand side in the kernel of a scene, measured when it is asked for.
#pragma once

#include <optional>

#include "point/line_solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

/// CPU seconds per right-hand side, with all that belongs to it in a run (flight, search for events),
/// measured on a few milliseconds of motion on the last line of the scene's grid, which has the largest
/// values of all swept quantities. Empty where no blade comes into contact there.
///
/// `go_on` is called between and within points; the result is empty where it returns false.
std::optional<double> seconds_per_right_hand_side(const settings::Scene& scene, const modes::GoOn& go_on);

}  // namespace rubatlas::mpi

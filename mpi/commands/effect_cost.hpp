/// What a right-hand side of a scene's own kernel costs, measured there and then.
#pragma once

#include <optional>

#include "point/line_solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

/// CPU seconds per right-hand side, with all that belongs to it in a run (flight, search for events), from a
/// few milliseconds of motion on the last line of the scene's grid: the one with the largest values of all
/// that is swept. None where no blade comes into contact there.
///
/// `go_on` is asked between and within points; where it says no, there is none either.
std::optional<double> seconds_per_right_hand_side(const settings::Scene& scene, const modes::GoOn& go_on);

}  // namespace rubatlas::mpi

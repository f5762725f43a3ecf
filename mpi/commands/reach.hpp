/// Does any blade reach the ring?
#pragma once

#include <optional>

#include "point/line_solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

/// Of a scene in which no blade ever touches the ring.
struct FreeReach {
  double displacement = 0.0;  ///< the shaft moves by no more from its equilibrium [m]
  double distance = 0.0;  ///< at which blades pass the ring at equilibrium, at its least over the grid [m]
};

/// From the equations of free motion alone (MODEL 4.5), without integration; none where a blade may touch, or
/// where that cannot be decided so: long grids, and effects that feed free motion.
std::optional<FreeReach> reach_without_contact(const settings::Scene& scene);

/// Whether a blade has been in contact in motions of this work that started from the scene's `initial`. In
/// doubt it has: methods that step through flight do not count contacts that are there from the start to the
/// end.
bool has_touched(const settings::Scene& scene, const motion::WorkCounts& work);

}  // namespace rubatlas::mpi

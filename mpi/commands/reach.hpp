/// Whether any blade reaches the ring.
#pragma once

#include <optional>

#include "point/line_solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

/// Result for a scene in which no blade ever touches the ring.
struct FreeReach {
  double displacement = 0.0;  ///< bound of the shaft's displacement from its equilibrium [m]
  double distance = 0.0;  ///< smallest distance over the grid at which blades pass the ring while the shaft
                          ///< is at equilibrium [m]
};

/// From the equations of free motion alone (MODEL 4.5), without integration. Empty where a blade may touch,
/// or where these equations cannot decide it: for long grids, and for effects that supply energy to free
/// motion.
std::optional<FreeReach> reach_without_contact(const settings::Scene& scene);

/// How far a blade with this misalignment overlaps the nearest point of the ring while the shaft is at
/// equilibrium [m]; negative: it passes at that distance. Nothing where a static load holds the shaft
/// elsewhere, or blades have different lengths.
std::optional<double> overlap_at_equilibrium(const settings::Scene& scene, double misalignment);

/// Largest distance, over the grid, of the shaft at the start from a point `height` above its equilibrium
/// [m].
double farthest_start(const settings::Scene& scene, double height);

/// Whether a blade has been in contact in motions of this work that started from the scene's `initial`. The
/// answer is true in doubt, because methods that step through flight do not count contacts that last from the
/// start to the end.
bool has_touched(const settings::Scene& scene, const motion::WorkCounts& work);

}  // namespace rubatlas::mpi

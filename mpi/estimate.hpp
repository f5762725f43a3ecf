/// What a scene's points cost, measured on a few of them.
#pragma once

#include <chrono>
#include <cstddef>

#include "scene/scene.hpp"
#include "solve/line_solver.hpp"

namespace rubatlas::mpi {

struct CostEstimate {
  std::size_t trials = 0;             ///< points tried
  std::size_t left_validity = 0;      ///< of these, how many left the model
  std::size_t integrator_failed = 0;  ///< and how many could not be integrated
  double seconds_per_point = 0.0;     ///< mean over the trials, CPU time of one rank
  double standard_error = 0.0;        ///< of that mean [s]
  double fastest = 0.0;               ///< [s]
  double slowest = 0.0;               ///< [s]
  double revolutions = 0.0;           ///< of all trials together
  int side_by_side = 1;               ///< lines in a batch, as one rank would have them
  solve::WorkCounts work;             ///< of all trials together
};

/// Runs points spread over the whole grid, each from the scene's `initial`, until `budget` is used up. Long
/// protocols are shortened and their time scaled, so that no trial takes much longer than the budget. Points
/// are tried in batches where the atlas is computed so.
CostEstimate estimate_cost(const scene::Scene& scene, std::chrono::duration<double> budget);

}  // namespace rubatlas::mpi

/// The cost of a scene's points, measured on a few of them.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "point/line_solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

/// A point that was computed, completely or in part.
struct TriedPoint {
  double speed_ratio = 0.0;       ///< Ω [-]
  bool touched = false;           ///< a blade was in contact
  std::optional<double> seconds;  ///< of CPU time, for the whole protocol; none where it was given up
};

struct CostEstimate {
  std::size_t trials = 0;             ///< points computed to their end
  std::size_t given_up = 0;           ///< points that were not finished in time
  std::size_t left_validity = 0;      ///< of the trials, points that left the model's validity
  std::size_t integrator_failed = 0;  ///< of the trials, points that could not be integrated
  double seconds_per_point = 0.0;  ///< mean, CPU time of one rank; 0 where not one revolution was completed
  double standard_error = 0.0;     ///< of that mean [s]
  double fastest = 0.0;            ///< [s]
  double slowest = 0.0;            ///< [s]
  double revolutions = 0.0;        ///< of all points tried together
  int most_revolutions = 0;        ///< of one point that was tried
  motion::WorkCounts work;         ///< of all points tried together
  std::vector<TriedPoint> points;  ///< in the order in which they ended
};

/// Time on the wall [s] from any zero.
using Clock = std::function<double()>;
double seconds_on_the_wall();

/// Computes points spread over the whole grid, each from the scene's `initial`. New points are begun for
/// `budget` [s]. Points that are not finished a quarter of this time later are given up, if need be within a
/// revolution. Long protocols are shortened and their time is scaled.
CostEstimate estimate_cost(const settings::Scene& scene, double budget,
                           const Clock& clock = seconds_on_the_wall);

}  // namespace rubatlas::mpi

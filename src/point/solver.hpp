/// The interface to the physics: computes one line of the atlas, point by point.
///
/// A scene's choices (contact law, effects, observables) become types once, in `make_line_solver`; from there
/// to the end of a point nothing is looked up by name. One virtual call per point.
#pragma once

#include "modes/work_meter.hpp"
#include "motion/point_start.hpp"

namespace rubatlas::point {

struct PointOutcome;
struct Orbit;
struct SectionMap;

class LineSolver {
 public:
  virtual ~LineSolver() = default;

  /// Runs transient and sampled revolutions at one speed ratio from `start`. `go_on` is asked after each
  /// revolution and every few milliseconds within (a rank answers its messages there): false gives the point
  /// up, whose status is then `pending`. An empty function is not called.
  virtual PointOutcome run(double speed_ratio, const motion::PointStart& start,
                           const modes::GoOn& go_on = {}) = 0;

  /// The same motion, kept as `samples_per_revolution` samples over the sampled revolutions.
  virtual Orbit orbit(double speed_ratio, const motion::PointStart& start) = 0;

  /// So many revolutions from `start`, and their derivative by the shaft's state there. Only for scenes with
  /// `variation::has_tangents`.
  virtual SectionMap section_map(double speed_ratio, const motion::PointStart& start, int revolutions) = 0;
};

}  // namespace rubatlas::point

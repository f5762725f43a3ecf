/// The interface to the physics: computes one line of the atlas, point by point.
///
/// A scene's choices (contact law, effects, observables) become objects once, in `make_line_solver`; from
/// there to the end of a point nothing is looked up by name.
#pragma once

#include "ending/status.hpp"
#include "modes/motion_listener.hpp"
#include "modes/work_meter.hpp"
#include "motion/point_start.hpp"

namespace rubatlas::point {

struct PointOutcome;
struct Orbit;
struct SectionMap;
struct TouchdownMap;

class LineSolver {
 public:
  virtual ~LineSolver() = default;

  /// Runs transient and sampled revolutions at one speed ratio from `start`. `go_on` is asked after each
  /// revolution and every few milliseconds within (a rank answers its messages there): false gives the point
  /// up, whose status is then `pending`. An empty function is not called.
  virtual PointOutcome run(double speed_ratio, const motion::PointStart& start,
                           const modes::GoOn& go_on = {}) = 0;

  /// The same motion, whose sampled revolutions `listener` follows as the observables do.
  virtual ending::PointStatus listen(double speed_ratio, const motion::PointStart& start,
                                     modes::MotionListener& listener) = 0;

  /// The same motion, kept as `samples_per_revolution` samples over the sampled revolutions.
  virtual Orbit orbit(double speed_ratio, const motion::PointStart& start) = 0;

  /// So many revolutions from `start`, and their derivative by the shaft's state there. Only for scenes that
  /// `settings::refusal_of_linearisation` does not refuse.
  virtual SectionMap section_map(double speed_ratio, const motion::PointStart& start, int revolutions) = 0;

  /// From a touch-down on over so many passings of blades, to where the blade that is then in its place comes
  /// to the ring. Only for scenes that `settings::refusal_of_shooting` does not refuse.
  virtual TouchdownMap touchdown_map(double speed_ratio, const motion::PointStart& start, int passings) = 0;
};

}  // namespace rubatlas::point

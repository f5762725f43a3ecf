/// The motion of one point by any method: the interface for the protocol, the recording and the changes of
/// the machine between revolutions. One virtual call per revolution.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <stdexcept>

#include "ending/status.hpp"
#include "modes/motion_listener.hpp"
#include "modes/work_meter.hpp"
#include "motion/point_start.hpp"
#include "motion/work_counts.hpp"
#include "rotor/bodies.hpp"

namespace rubatlas::motion {

class PointMotion {
 public:
  virtual ~PointMotion() = default;

  // Each says what has ended the motion, `none` where it goes on.
  /// Methods that ours is compared with throw std::logic_error at a touch-down.
  virtual ending::StatusDetail start(const PointStart& start) = 0;
  /// The next revolution. `number` counts from the first sampled revolution and is negative in the transient.
  virtual ending::StatusDetail revolution(modes::MotionListener& listener, const modes::GoOn& go_on,
                                          int number) = 0;
  /// Goes on at phase 0 from where a motion of the same kind, with another speed or other blades, has ended,
  /// and counts its work in. Throws std::logic_error for methods that ours is compared with.
  virtual ending::StatusDetail take_over(PointMotion& /*before*/) {
    throw std::logic_error("no other motion goes on from one of this method");
  }

  /// State at the end of the last revolution; a ring that is not a body is at zero.
  [[nodiscard]] virtual rotor::ShaftAndRing state() const = 0;
  /// What the next point needs besides the shaft's state.
  [[nodiscard]] virtual Memory memory() const { return {}; }
  /// Largest growth of a blade's clearance since the point started [m].
  [[nodiscard]] virtual double clearance_growth() const { return 0.0; }
  [[nodiscard]] virtual WorkCounts work() const = 0;
};

/// Makes the motion of a line's point at a speed ratio Ω. `lost`: the length that each blade has lost [m],
/// empty where no blade wears.
using MakeMotion =
    std::function<std::unique_ptr<PointMotion>(double speed_ratio, std::span<const double> lost)>;

}  // namespace rubatlas::motion

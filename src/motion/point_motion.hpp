/// The motion of one point, for any combination of law, bodies and effects: the interface for the protocol,
/// the recording and the changes of the machine between revolutions. One virtual call per revolution.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "ending/status.hpp"
#include "modes/motion_listener.hpp"
#include "modes/work_meter.hpp"
#include "motion/point_start.hpp"
#include "motion/work_counts.hpp"
#include "rotor/bodies.hpp"

namespace rubatlas::motion {

class PointMotion {
 public:
  PointMotion() = default;
  PointMotion(const PointMotion&) = delete;
  PointMotion& operator=(const PointMotion&) = delete;
  virtual ~PointMotion() = default;

  virtual ending::PointStatus start(const PointStart& start) = 0;
  /// Starts where a blade touches down. Throws std::logic_error for a machine that changes, and for methods
  /// that ours is compared with.
  virtual ending::PointStatus start_at_touch_down(const TouchdownStart& /*start*/) {
    throw std::logic_error("this motion does not start at a touch-down");
  }
  /// The next revolution. `number` counts from the first sampled revolution and is negative in the transient.
  virtual ending::PointStatus revolution(modes::MotionListener& listener, const modes::GoOn& go_on,
                                         int number) = 0;
  /// Goes on at phase 0 from where a motion of the same kind, with another speed or other blades, has ended.
  /// Throws std::logic_error for a machine that does not change.
  virtual ending::PointStatus take_over(PointMotion& before) = 0;

  /// What ended the motion, where its status is not `done`.
  [[nodiscard]] virtual ending::StatusDetail status_detail() const = 0;
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

/// A compiled motion of a shaft, or of a shaft and a ring. `kMayChange`: another motion may take over from
/// it.
template <class Motion, bool kMayChange>
class TypedMotion final : public PointMotion {
 public:
  template <class... Arguments>
  explicit TypedMotion(Arguments&&... arguments) : motion_(std::forward<Arguments>(arguments)...) {}

  ending::PointStatus start(const PointStart& start) override {
    const rotor::ShaftAndRing bodies = bodies_of(start);
    if constexpr (kHasRing) {
      return motion_.start(bodies);
    } else {
      return motion_.start(rotor::shaft(bodies));
    }
  }
  ending::PointStatus start_at_touch_down(const TouchdownStart& start) override {
    if constexpr (requires { motion_.start(motion_.state(), 0.0, 0); } && !kHasRing) {
      return motion_.start(rotor::shaft(bodies_of(start)), start.time, start.blade);
    } else {
      return PointMotion::start_at_touch_down(start);
    }
  }
  ending::PointStatus revolution(modes::MotionListener& listener, const modes::GoOn& go_on,
                                 int /*number*/) override {
    return motion_.revolution(listener, go_on);
  }
  ending::PointStatus take_over([[maybe_unused]] PointMotion& before) override {
    if constexpr (kMayChange) {
      return motion_.take_over(dynamic_cast<TypedMotion&>(before).motion_.hand_over());
    } else {
      throw std::logic_error("this motion's machine does not change between revolutions");
    }
  }

  [[nodiscard]] ending::StatusDetail status_detail() const override { return motion_.status_detail(); }
  [[nodiscard]] rotor::ShaftAndRing state() const override {
    if constexpr (kHasRing) {
      return motion_.state();
    } else {
      rotor::ShaftAndRing bodies = rotor::ShaftAndRing::Zero();
      bodies.head<4>() = motion_.state();
      return bodies;
    }
  }
  [[nodiscard]] Memory memory() const override {
    if constexpr (kHasRing) return Memory(rotor::as_array(rotor::ring(motion_.state())));
    return {};
  }
  [[nodiscard]] WorkCounts work() const override { return motion_.work(); }

 private:
  static constexpr bool kHasRing =
      std::is_same_v<std::remove_cvref_t<decltype(std::declval<Motion>().state())>, rotor::ShaftAndRing>;

  static rotor::ShaftAndRing bodies_of(const PointStart& start) {
    rotor::ShaftAndRing bodies = rotor::ShaftAndRing::Zero();
    bodies.head<4>() = rotor::as_state(start.state);
    // Without a memory the ring starts at its place of rest, without velocity.
    const std::span<const double> ring = start.memory.view();
    if (kHasRing && !ring.empty()) bodies.tail<4>() = rotor::State(ring.data());
    return bodies;
  }

  Motion motion_;
};

}  // namespace rubatlas::motion

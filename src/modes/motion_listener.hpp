/// A listener of a motion: receives the motion's pieces and events in order of time.
#pragma once

#include <array>
#include <cstdint>

#include "rotor/constants.hpp"
#include "trajectory/motion_piece.hpp"

namespace rubatlas::modes {

/// What may end a mode: its guards, or one of the other ends of a motion.
enum class Guard : std::uint8_t {
  horizon,  ///< none: the end of the revolution
  lift_off,
  touch_down,
  slip_reversal,
  comes_loose,  ///< a tip at rest begins to slip
  pressed_in,   ///< a tip that has skimmed has its full force, or a straight blade bends
  snap,         ///< a blade has come to the end of its branch of equilibria and goes over to the next
  left_validity,
  failed
};

/// A touch-down, lift-off, slip reversal, snap, or end of sticking or skimming.
struct Event {
  Guard kind;
  int blade;    ///< from 0
  double time;  ///< τ of the revolution
  double slip;  ///< s: after a touch-down or reversal, before a lift-off; 0 of a tip that sticks
  rotor::State state;
};

/// The class itself ignores everything: it is the listener of the transient.
class MotionListener {
 public:
  virtual ~MotionListener() = default;
  virtual void piece(trajectory::MotionPiece& /*piece*/) {}
  virtual void event(const Event& /*event*/) {}
  /// The next revolution has this Ω. Never called where the speed does not ramp.
  virtual void speed_changes(double /*speed_ratio*/) {}
  /// After a sampled revolution: the shaft's state there. Called by the protocol of a point, not by a motion.
  virtual void revolution_ends(const std::array<double, 4>& /*section*/) {}
};

}  // namespace rubatlas::modes

/// The interface of an observable, which gathers one row from the sampled revolutions of one point.
///
/// On a cycle only its first period is observed, or what the protocol samples of that: what is counted is
/// counted over the revolutions that have been observed, and what has a value for each revolution repeats
/// them.
#pragma once

#include <span>

#include "trajectory/motion_piece.hpp"
#include "variation/tangents.hpp"

namespace rubatlas::observables {

class Observable {
 public:
  virtual ~Observable() = default;

  /// The sampled revolutions of a point start: everything gathered for the point before is cleared.
  virtual void begin(const trajectory::PointConstants& point) = 0;
  /// Called behind `begin` where the motion is one period of a cycle, which stands for all sampled
  /// revolutions. `return_map`: what it makes of small differences at its start, those of the ring included;
  /// empty where it is not known.
  virtual void on_cycle(const variation::Tangents& /*return_map*/) {}
  virtual void piece(trajectory::MotionPiece& /*piece*/) {}
  virtual void touch_down(int /*blade*/) {}
  virtual void lift_off(int /*blade*/) {}
  virtual void slip_reverses(int /*blade*/) {}
  /// Any other event: a tip sticks or comes loose, skims or is pressed in, a blade snaps.
  virtual void changes_otherwise() {}
  /// The revolution is over; `section` is the state there.
  virtual void revolution_ends(const trajectory::State& /*section*/) {}
  /// The next revolution has another speed. Called only where the speed ramps.
  virtual void speed_changes(const trajectory::PointConstants& /*point*/) {}
  /// Growth of the largest clearance of a blade since the point started [m]. Called once, before `write`, and
  /// only where blades wear.
  virtual void clearance_grows(double /*growth*/) {}
  /// The row, once all revolutions that are observed are over.
  virtual void write(std::span<double> row) = 0;
  /// The rows that are kept beside it, where it has some, counted from 0.
  virtual void write_beside(int /*number*/, std::span<double> /*row*/) {}
};

}  // namespace rubatlas::observables

/// What the list holds: an observable gathers one row from the sampled revolutions of one point.
#pragma once

#include <span>

#include "observables/motion_piece.hpp"

namespace rubatlas::observables {

class Observable {
 public:
  virtual ~Observable() = default;

  /// A point's sampled revolutions start: forget the last point.
  virtual void begin(const PointConstants& point) = 0;
  virtual void piece(MotionPiece& /*piece*/) {}
  virtual void touch_down() {}
  /// The revolution is over; `section` is the state there.
  virtual void revolution_ends(const State& /*section*/) {}
  /// The revolution that follows turns at another speed. Called where the speed ramps only.
  virtual void speed_changes(const PointConstants& /*point*/) {}
  /// By how much the largest clearance of a blade has grown since the point started [m]. Called once, before
  /// `write`, where blades wear only.
  virtual void clearance_grows(double /*growth*/) {}
  /// The row, once all revolutions are over.
  virtual void write(std::span<double> row) = 0;
};

}  // namespace rubatlas::observables

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
  /// The row, once all revolutions are over.
  virtual void write(std::span<double> row) = 0;
};

}  // namespace rubatlas::observables

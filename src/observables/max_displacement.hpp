/// Observable `max_displacement`: supremum over continuous time of sqrt(x² + y²) (MODEL 6).
#pragma once

#include <memory>

#include "observables/observable.hpp"
#include "settings/scene.hpp"

namespace rubatlas::observables {

class MaxDisplacement final : public Observable {
 public:
  static std::unique_ptr<Observable> make(const settings::Scene&) {
    return std::make_unique<MaxDisplacement>();
  }

  void begin(const trajectory::PointConstants& point) override {
    speed_ratio_ = point.speed_ratio;
    largest_ = 0.0;
  }
  void speed_changes(const trajectory::PointConstants& point) override { speed_ratio_ = point.speed_ratio; }
  void piece(trajectory::MotionPiece& piece) override {
    largest_ = piece.largest_displacement(largest_, speed_ratio_);
  }
  void write(std::span<double> row) override { row[0] = largest_; }

 private:
  double speed_ratio_ = 0.0;
  double largest_ = 0.0;  ///< [m]
};

}  // namespace rubatlas::observables

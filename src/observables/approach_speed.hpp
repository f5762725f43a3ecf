/// Observable `approach_speed`: the largest speed at which the tip of an undeformed blade moves towards the
/// ring where it touches down [m/s], d|tip|/dt. 0 without touch-downs.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "observables/observable.hpp"
#include "settings/scene.hpp"

namespace rubatlas::observables {

class ApproachSpeed final : public Observable {
 public:
  explicit ApproachSpeed(const settings::Scene& scene) : frequency_(scene.rotor.natural_frequency) {}
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<ApproachSpeed>(scene);
  }
  void begin(const trajectory::PointConstants& /*point*/) override {
    fastest_ = 0.0;
    touched_.clear();
  }
  void touch_down(int blade) override { touched_.push_back(blade); }
  /// The piece that begins where blades have touched down.
  void piece(trajectory::MotionPiece& piece) override {
    for (const int blade : touched_) fastest_ = std::max(fastest_, piece.tip(blade, piece.begin()).rate);
    touched_.clear();
  }
  void write(std::span<double> row) override { row[0] = frequency_ * fastest_; }

 private:
  double frequency_;          ///< ωn [rad/s]
  double fastest_ = 0.0;      ///< [m per unit τ]
  std::vector<int> touched_;  ///< blades, since the last piece
};

}  // namespace rubatlas::observables

/// The observables that a scene asks for, fed together.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "observables/list.hpp"
#include "observables/observable.hpp"

namespace rubatlas::observables {

class Recorder {
 public:
  explicit Recorder(const scene::Scene& scene);

  void begin(const PointConstants& point) {
    for (auto& observable : observables_) observable->begin(point);
  }
  void piece(MotionPiece& piece) {
    for (auto& observable : observables_) observable->piece(piece);
  }
  void touch_down() {
    for (auto& observable : observables_) observable->touch_down();
  }
  void revolution_ends(const State& section) {
    for (auto& observable : observables_) observable->revolution_ends(section);
  }
  /// One row per description; NaN throughout unless the point is done.
  [[nodiscard]] Rows rows(bool done);

 private:
  std::vector<Description> descriptions_;
  std::vector<std::unique_ptr<Observable>> observables_;
};

}  // namespace rubatlas::observables

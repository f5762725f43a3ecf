/// The observables of a scene as one object, to which the motion is handed once.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "observables/list.hpp"
#include "observables/observable.hpp"

namespace rubatlas::observables {

class Recorder {
 public:
  explicit Recorder(const settings::Scene& scene);

  void begin(const trajectory::PointConstants& point) {
    blade_count_ = point.blade_count;
    for (auto& observable : observables_) observable->begin(point);
  }
  void on_cycle(const variation::Tangents& return_map) {
    for (auto& observable : observables_) observable->on_cycle(return_map);
  }
  /// The next revolution has another Ω.
  void speed_changes(double speed_ratio) {
    const trajectory::PointConstants point{2.0 * std::numbers::pi / std::abs(speed_ratio), speed_ratio,
                                           blade_count_};
    for (auto& observable : observables_) observable->speed_changes(point);
  }
  void clearance_grows(double growth) {
    for (auto& observable : observables_) observable->clearance_grows(growth);
  }
  void piece(trajectory::MotionPiece& piece) {
    for (auto& observable : observables_) observable->piece(piece);
  }
  void touch_down(int blade) {
    for (auto& observable : observables_) observable->touch_down(blade);
  }
  void lift_off(int blade) {
    for (auto& observable : observables_) observable->lift_off(blade);
  }
  void slip_reverses(int blade) {
    for (auto& observable : observables_) observable->slip_reverses(blade);
  }
  void changes_otherwise() {
    for (auto& observable : observables_) observable->changes_otherwise();
  }
  void revolution_ends(const trajectory::State& section) {
    for (auto& observable : observables_) observable->revolution_ends(section);
  }
  /// One row per description; NaN throughout unless the point is done.
  [[nodiscard]] Rows rows(bool done);

 private:
  std::vector<Description> descriptions_;
  /// Who writes each of the rows: `beside` is −1 for the row of an observable itself.
  struct Writer {
    std::size_t observable;
    int beside;
  };
  std::vector<Writer> writers_;
  std::vector<std::unique_ptr<Observable>> observables_;
  int blade_count_ = 0;
};

}  // namespace rubatlas::observables

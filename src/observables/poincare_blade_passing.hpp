/// Observable `poincare_blade_passing`: the state n times per revolution, each time a blade stands where
/// blade 1 stood at phase 0. With n equal blades and no unbalance this is the natural period of the problem.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "observables/observable.hpp"
#include "observables/repeated.hpp"
#include "settings/scene.hpp"

namespace rubatlas::observables {

class PoincareBladePassing final : public Observable {
 public:
  static std::unique_ptr<Observable> make(const settings::Scene&) {
    return std::make_unique<PoincareBladePassing>();
  }

  void begin(const trajectory::PointConstants& point) override {
    point_ = point;
    passing_ = 1;
    values_.clear();
  }
  void speed_changes(const trajectory::PointConstants& point) override { point_ = point; }
  void piece(trajectory::MotionPiece& piece) override {
    // The last passing of a revolution is its section.
    for (; passing_ < point_.blade_count; ++passing_) {
      const double time = point_.period * passing_ / point_.blade_count;
      if (time > piece.end()) return;
      append(piece.state(time));
    }
  }
  void revolution_ends(const trajectory::State& section) override {
    append(section);
    passing_ = 1;
  }
  void write(std::span<double> row) override {
    std::copy(values_.begin(), values_.end(), row.begin());
    repeat(row, values_.size());
  }

 private:
  void append(const trajectory::State& state) { values_.insert(values_.end(), state.begin(), state.end()); }

  trajectory::PointConstants point_{};
  int passing_ = 1;             ///< next one within the revolution
  std::vector<double> values_;  ///< passing × component
};

}  // namespace rubatlas::observables

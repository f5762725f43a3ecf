/// Observable `poincare`: the state once per revolution, at phase 0 (MODEL 6).
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "observables/observable.hpp"
#include "observables/repeated.hpp"
#include "settings/scene.hpp"

namespace rubatlas::observables {

class Poincare final : public Observable {
 public:
  static std::unique_ptr<Observable> make(const settings::Scene&) { return std::make_unique<Poincare>(); }

  void begin(const trajectory::PointConstants& /*point*/) override { values_.clear(); }
  void revolution_ends(const trajectory::State& section) override {
    values_.insert(values_.end(), section.begin(), section.end());
  }
  void write(std::span<double> row) override {
    std::copy(values_.begin(), values_.end(), row.begin());
    repeat(row, values_.size());
  }

 private:
  std::vector<double> values_;  ///< section × component
};

}  // namespace rubatlas::observables

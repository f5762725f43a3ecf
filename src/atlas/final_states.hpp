/// The values from which the next point of a line starts: the final state of a point, and what effects
/// remember besides.
#pragma once

#include <cstddef>
#include <vector>

#include "atlas/atlas_reader.hpp"
#include "point/line_solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::atlas {

/// `/final_state` and each `/final_state_<effect>` of a whole atlas.
class FinalStates {
 public:
  FinalStates() = default;
  /// `scene` is the scene of the atlas.
  FinalStates(const AtlasReader& atlas, const settings::Scene& scene);

  /// The final state and memory of a point whose status is done.
  [[nodiscard]] motion::PointStart of(std::size_t point) const;

 private:
  struct Rows {
    std::size_t size = 0;  ///< of one point
    std::vector<double> values;
  };
  std::vector<double> states_;
  std::vector<Rows> memories_;  ///< in the order of `observables::memories`
};

}  // namespace rubatlas::atlas

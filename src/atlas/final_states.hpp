/// The values from which the next point of a line starts: the final state of a point, and what effects
/// remember besides. They are read from the file point by point, since an atlas may have more points than fit
/// into memory.
#pragma once

#include <cstddef>
#include <vector>

#include "atlas/hdf5.hpp"
#include "atlas/schema.hpp"
#include "point/line_solver.hpp"

namespace rubatlas::atlas {

/// `/final_state` and each `/final_state_<effect>` of an atlas.
class FinalStates {
 public:
  /// `file` is an atlas of this schema.
  FinalStates(const File& file, const Schema& schema);

  /// The final state and memory of a point whose status is done.
  [[nodiscard]] motion::PointStart of(std::size_t point) const;

  /// To be called before the file is closed, if that is to be done under MPI.
  void close();

 private:
  Shape grid_;
  Dataset states_;
  std::vector<Dataset> memories_;  ///< in the order of `observables::memories`
};

}  // namespace rubatlas::atlas

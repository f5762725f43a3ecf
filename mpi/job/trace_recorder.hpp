/// Takes from each point of a scene with `pieces` what its motion is recognised by, also where the atlas does
/// not keep sections or maximum displacement.
#pragma once

#include <cstddef>
#include <vector>

#include "analysis/rules/same_motion.hpp"
#include "point/line_solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

class TraceRecorder {
 public:
  explicit TraceRecorder(const settings::Scene& scene);

  /// The scene with the observables that a trace needs besides its own. To observe a motion never changes it.
  [[nodiscard]] const settings::Scene& observed() const { return observed_; }

  [[nodiscard]] analysis::MotionTrace trace(const point::PointOutcome& outcome) const;
  /// Whether this is the motion of `found`, and what follows it the same. A cycle has to be in the same
  /// phase: where it ends, it is the phase that decides what the next point falls to.
  [[nodiscard]] bool is_same_motion(const point::PointOutcome& outcome,
                                    const analysis::MotionTrace& found) const;
  /// Removes the rows that the atlas does not keep.
  void strip(point::PointOutcome& outcome) const;

 private:
  settings::Scene observed_;
  analysis::ClosingTolerance closing_;
  double same_;               ///< distance within which the ends of two points are the same [m]
  std::size_t sections_ = 0;  ///< places of both rows in an outcome
  std::size_t displacement_ = 0;
  std::vector<std::size_t> added_;  ///< places of rows that the atlas does not keep, descending
};

}  // namespace rubatlas::mpi

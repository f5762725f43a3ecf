/// The door: points of several lines at once in one thread, so that steps of their motions can be made side
/// by side in SIMD lanes. The results have the bits of the lines' own solvers, whatever else is under way.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "assembly/make_line_solver.hpp"
#include "plan/grid.hpp"
#include "point/line_solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::batch {

/// How many lines of a scene this processor follows side by side.
struct Width {
  int seats = 1;            ///< 1: one after the other
  std::string_view reason;  ///< why that is so, a phrase
};

/// `most`: the caller's own bound; 0 sets none.
Width width_of(const settings::Scene& scene, int most = 0);

/// As `solve::make_line_solver`, for a line that is to run in a batch of this width.
std::unique_ptr<point::LineSolver> make_line_solver(const Width& width, const settings::Scene& scene,
                                                    const plan::PointParameters& line,
                                                    const std::shared_ptr<assembly::BladeTables>& tables);

/// How the attempts of contact steps were made; never part of the atlas.
struct LaneCounts {
  std::uint64_t batches = 0;   ///< of more than one attempt
  std::uint64_t in_lanes = 0;  ///< attempts made in them
};

/// A point that has ended.
struct Finished {
  int seat = 0;
  point::PointOutcome outcome;
  double seconds = 0.0;  ///< its share of the time: while n points are under way each is charged with an n-th
};

class LineBatch {
 public:
  virtual ~LineBatch() = default;

  /// Puts a point on a free seat, from 0 to `Width::seats` − 1. Solver and start outlive it; a solver sits on
  /// one seat at a time.
  virtual void begin(int seat, point::LineSolver& solver, double speed_ratio,
                     const motion::PointStart& start) = 0;

  /// Goes on with all points until one has ended; at least one is under way. `go_on` is asked for each of
  /// them, after each revolution and within long ones, and may begin points on free seats; false gives up the
  /// point for which it was asked. What a solver throws is thrown here; the batch is of no further use then.
  virtual Finished advance(const modes::GoOn& go_on) = 0;

  [[nodiscard]] virtual LaneCounts counts() const = 0;
};

std::unique_ptr<LineBatch> make_line_batch(const Width& width);

}  // namespace rubatlas::batch

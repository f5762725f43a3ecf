/// Points that are computed in rounds: rank 0 knows which points the next round has when it knows what became
/// of those of the last one.
///
/// The points of a round are dealt to the ranks in turn. What a point gives depends on where it is and what
/// it starts from, and not on the rank.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "assembly/make_line_solver.hpp"
#include "mpi/job/session.hpp"
#include "plan/grid.hpp"
#include "point/line_solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

/// A point of a round.
struct RoundPoint {
  std::uint64_t line = 0;  ///< of the scene's grid
  double speed_ratio = 0.0;
  std::uint8_t from_initial = 1;  ///< it starts from the line's `initial` ...
  motion::PointStart start;       ///< ... else from here
};

/// What became of a point.
struct RoundResult {
  ending::PointStatus status = ending::PointStatus::pending;  ///< pending: given up
  std::uint8_t motion = 0;                                    ///< class per revolution where it is done
  motion::PointStart end;                                     ///< where it is done
};

class Rounds {
 public:
  /// Asked between and within points; false gives the point up.
  using GoOn = std::function<bool()>;

  Rounds(const Session& session, const settings::Scene& scene);

  /// On rank 0: computes a round on all ranks; results in the order of the points. `after_point` is called
  /// after each of rank 0's own points. A round without points ends the rounds.
  std::vector<RoundResult> compute(std::span<const RoundPoint> points, const GoOn& go_on,
                                   const std::function<void(const RoundResult&)>& after_point);
  /// On the other ranks: takes part until a round has no points.
  void take_part(const GoOn& go_on);

 private:
  struct LineSolver {
    std::uint64_t line = 0;
    settings::Scene scene;
    std::unique_ptr<point::LineSolver> solver;
    motion::PointStart initial;  ///< of points that start anew
  };

  RoundResult compute(const RoundPoint& point, const GoOn& go_on);
  std::vector<RoundResult> compute_share(std::span<const RoundPoint> points, const GoOn& go_on,
                                         const std::function<void(const RoundResult&)>& after_point);

  const Session& session_;
  settings::Scene scene_;  ///< observes sections only
  plan::Grid grid_;
  std::shared_ptr<assembly::BladeTables> tables_ = assembly::make_blade_tables();
  std::optional<LineSolver> line_;  ///< that of the last point; the points of a round are sorted by line
  std::size_t sections_ = 0;        ///< place of the sections in an outcome
};

}  // namespace rubatlas::mpi

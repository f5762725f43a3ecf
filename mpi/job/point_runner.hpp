/// Computes assignments and writes their rows. Every rank has one, the master too.
///
/// Where lines are swept in pieces (`plan::Pieces`), the rank that has computed a point holds its row until
/// it is known whether the piece before leads to the same motion. A row is therefore written once, and a
/// status in the atlas is final. Held rows are lost with their rank, and computed again by a resumed run.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <vector>

#include "assembly/make_line_solver.hpp"
#include "atlas/atlas_writer.hpp"
#include "mpi/clock.hpp"
#include "mpi/job/mailbox.hpp"
#include "mpi/job/messages.hpp"
#include "mpi/job/session.hpp"
#include "mpi/job/trace_recorder.hpp"
#include "plan/grid.hpp"
#include "point/line_solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

class PointRunner {
 public:
  PointRunner(const settings::Scene& scene, const plan::Grid& grid, atlas::AtlasWriter& writer);

  struct Callbacks {
    std::function<bool()>
        go_on;  ///< asked every `Mailbox::kLookPeriod`; after false all points are given up, for good
    std::function<void(const Report&)> after_points;  ///< their rows are in the atlas or held
  };

  /// Number of solvers that a rank keeps: ranks change lines near the end of a job, when few lines are left.
  static constexpr std::size_t kSolversKept = 16;

  /// Takes an assignment on; there must be none. From here on verdicts concern its points.
  void begin(const Assignment& assignment) { left_ = assignment; }
  [[nodiscard]] bool has_assignment() const { return left_.count > 0; }

  /// Computes the points of the assignment in order, until its end or until points are to be given up. Each
  /// starts from the end of the point before it, or from the scene's `initial` if that point did not end as
  /// done or points are independent. Then there is no assignment.
  void run(const Callbacks& callbacks);

  /// Writes the held rows that are kept, and forgets the others of that piece.
  void take(const Verdict& verdict);

  /// Forces written rows to the disk when a batch is due; to be called while there is nothing to compute.
  void idle() { commit_if_due(); }

 private:
  struct CachedSolver {
    std::size_t line = 0;
    std::unique_ptr<point::LineSolver> solver;
  };

  /// A point whose row is neither kept nor dropped yet.
  struct HeldPoint {
    std::uint64_t line = 0;
    std::uint64_t visit = 0;
    bool restarted = false;
    point::PointOutcome outcome;
    plan::Seam seam = plan::Seam::none;  ///< where the piece before leads to this point
  };

  class Interruption;

  /// Looks after messages and the disk; false when all points are to be given up.
  bool attend(const Callbacks& callbacks);
  void commit_if_due();
  /// Adds the time that a call of the writer takes to the time of writing.
  void write(void (atlas::AtlasWriter::*call)());
  void report(const Callbacks& callbacks);
  void finish_point(point::PointOutcome outcome, double seconds, const Callbacks& callbacks);
  void keep_row(point::PointOutcome& outcome, PointReport& computed);
  point::LineSolver& solver_of(std::size_t line);

  const settings::Scene scene_;          ///< its axes have one value each
  std::optional<TraceRecorder> traces_;  ///< where lines are swept in pieces; solvers refer to its scene
  const plan::Grid& grid_;
  atlas::AtlasWriter& writer_;
  std::shared_ptr<assembly::BladeTables> tables_ = assembly::make_blade_tables();
  std::list<CachedSolver> solvers_;                 ///< most recently used first
  Assignment left_;                                 ///< the rest of the assignment, from its next point on
  Report report_;                                   ///< computed points that have not been reported
  std::chrono::steady_clock::time_point reported_;  ///< the last report, or the beginning of the assignment
  std::vector<HeldPoint> held_;
  bool goes_on_ = true;  ///< no point has been given up
  Pace pace_{Mailbox::kLookPeriod};
  ProcessorWatch integrating_;
  double processor_at_start_ = processor_seconds();
  double writing_seconds_ = 0.0;
};

}  // namespace rubatlas::mpi

/// Rank 0: hands out pieces, keeps count, and computes pieces itself in between.
///
/// It answers its workers between the revolutions of its own points, so nobody waits for longer than one
/// revolution takes, and it costs no rank: N ranks compute on N cores.
#pragma once

#include <chrono>
#include <cstddef>
#include <set>
#include <vector>

#include "mpi/mailbox.hpp"
#include "mpi/point_runner.hpp"
#include "mpi/progress.hpp"
#include "mpi/schedule.hpp"
#include "mpi/session.hpp"

namespace rubatlas::mpi {

/// What a job has done when it ends.
struct JobResult {
  Standing standing;
  bool stopped = false;                       ///< on request, with points still pending
  std::vector<std::uint64_t> points_of_rank;  ///< computed in this run
  std::vector<double> busy_seconds_of_rank;   ///< spent in points
  solve::WorkCounts work;
};

class Master {
 public:
  /// `standing`: where the atlas stands before the run.
  Master(const Session& session, const Mailbox& mailbox, Schedule& schedule, PointRunner& runner,
         Progress& progress, const Standing& standing);

  /// Until every point is computed and every worker has left, or the job is asked to stop.
  JobResult run();

 private:
  void serve();
  void serve_when_due();
  void take(int rank, const PointReport& report);
  void stop_workers();
  void hand_out();
  [[nodiscard]] Standing standing() const;

  const Mailbox& mailbox_;
  Schedule& schedule_;
  PointRunner& runner_;
  Progress& progress_;
  JobResult result_;
  std::vector<int> idle_;  ///< workers that have asked for a piece
  std::set<int> workers_;  ///< that have not left
  bool stopping_ = false;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point next_service_;
};

}  // namespace rubatlas::mpi

/// Rank 0: hands out pieces, keeps count, and computes pieces itself in between.
///
/// It answers its workers between the revolutions of its own points, so nobody waits for longer than one
/// revolution takes, and it costs no rank: N ranks compute on N cores. A rank that follows several lines side
/// by side gets a piece for each of its seats, as long as no rank has fewer than its share of the lines left.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "mpi/job/mailbox.hpp"
#include "mpi/job/point_runner.hpp"
#include "mpi/job/progress.hpp"
#include "mpi/job/schedule.hpp"
#include "mpi/job/session.hpp"

namespace rubatlas::mpi {

/// What a job has done when it ends.
struct JobResult {
  Standing standing;
  std::vector<std::uint64_t> points_of_rank;  ///< computed in this run
  std::vector<double> busy_seconds_of_rank;   ///< spent in points
  motion::WorkCounts work;
  std::map<point::StatusDetail, std::size_t> ended_by;  ///< points of this run that are not done
};

class Master {
 public:
  /// What it tells others while the job runs.
  struct Reports {
    Progress& progress;
    std::function<void(const JobResult&)> keep_record;  ///< now and then, and when the job is asked to stop
    std::string how_to_go_on;                           ///< a sentence for who has stopped the job
  };
  /// `standing`: where the atlas stands before the run.
  Master(const Session& session, const Mailbox& mailbox, Schedule& schedule, PointRunner& runner,
         Reports reports, const Standing& standing);

  /// Until every point is computed and every worker has left, or the job is asked to stop.
  JobResult run();

 private:
  void serve();
  void take(int rank, const PointReport& report);
  void seat_is_free(int rank, int seat);
  void stop();
  void hand_out();
  [[nodiscard]] int next_to_serve() const;
  void dismiss_workers();
  [[nodiscard]] Standing standing() const;
  [[nodiscard]] JobResult so_far() const;

  static constexpr std::chrono::seconds kRecordPeriod{10};

  const Mailbox& mailbox_;
  Schedule& schedule_;
  PointRunner& runner_;
  Reports reports_;
  JobResult result_;
  /// What a rank does, as far as its messages have come.
  struct Rank {
    int seats = 0;                ///< 0: not heard of yet
    std::vector<int> free_seats;  ///< that have asked for a piece
    int pieces = 0;               ///< that it computes
    bool has_left = false;
  };
  std::vector<Rank> ranks_;
  int workers_;  ///< that have not left
  bool stopping_ = false;
  std::chrono::steady_clock::time_point start_;
  Pace pace_{Mailbox::kLookPeriod};
  Pace record_pace_{kRecordPeriod};
};

}  // namespace rubatlas::mpi

/// Rank 0: hands out assignments, counts points, and computes assignments itself in between.
///
/// It answers its workers between the revolutions of its own points, so that no worker waits for longer than
/// one revolution takes. All N ranks compute, since no rank is set aside as master.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
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

/// The result of a job.
struct JobResult {
  Standing standing;
  std::vector<std::uint64_t> points_of_rank;  ///< computed in this run
  std::vector<RankTimes> times_of_rank;       ///< up to its last report
  motion::WorkCounts work;
  std::map<ending::StatusDetail, std::size_t> ended_by;  ///< points of this run that are not done
};

class Master {
 public:
  /// Receivers of what the master reports while the job runs.
  struct Reports {
    Progress& progress;
    std::function<void(const JobResult&)> keep_record;  ///< now and then, and when the job is asked to stop
    std::string how_to_go_on;  ///< a sentence for the user who has stopped the job: how to resume it
  };
  /// `standing`: the numbers of finished points before the run.
  Master(const Session& session, const Mailbox& mailbox, Schedule& schedule, PointRunner& runner,
         Reports reports, const Standing& standing);

  /// Returns when every point is computed and every worker has left, or when the job was asked to stop.
  JobResult run();

 private:
  void serve();
  void take(std::size_t rank, const Report& report);
  void send(const Schedule::Decision& decision);
  void stop();
  void hand_out();
  void dismiss_workers();
  [[nodiscard]] Standing standing() const;
  [[nodiscard]] JobResult so_far() const;

  static constexpr std::chrono::seconds kRecordPeriod{10};

  const Mailbox& mailbox_;
  Schedule& schedule_;
  PointRunner& runner_;
  Reports reports_;
  JobResult result_;
  /// State of a rank according to the messages received from it.
  enum class RankState : std::uint8_t { not_heard_of, free, computing, has_left };
  std::vector<RankState> ranks_;
  int workers_;  ///< workers that have not left
  bool stopping_ = false;
  std::chrono::steady_clock::time_point start_;
  Pace record_pace_{kRecordPeriod};
};

}  // namespace rubatlas::mpi

/// The points that are still to be computed, and the next of them for each rank.
///
/// In a sweep each point starts from the end of the point before it. A run of points (a line, or a piece of
/// it with its lead-in, `plan::Pieces`) is therefore handed out in order, and to one rank at a time, in
/// assignments of up to 64 points. An assignment contains its start state, so that the next one may go to
/// another rank. While there are many runs a rank stays with its own. When few are left, the run with the
/// most work left goes first. Preempting a run at the end of an assignment costs nothing; with free
/// preemption this rule reaches McNaughton's bound, total work over number of ranks, up to the length of an
/// assignment, unless a single run takes longer. Independent points have no order: any rank gets any of them.
///
/// Seams. Along each line a front separates the points that stand from those that may still be replaced. When
/// it arrives at the first point of a piece, this point is computed from the end of the point before and
/// compared with what the run of the piece has found. If both motions are the same, the piece stands as far
/// as its own run; else the point is replaced, and the front goes on to the next point. Fronts would keep
/// ranks waiting at the end of a job. Where a run has ended before the front has arrived there, the first
/// point behind it is therefore compared ahead of the front, on the assumption that nothing will be replaced.
/// If the assumption fails, the comparison is made again.
///
/// The choice of a run looks at a bounded number of runs for each rank, however many there are. The schedule
/// knows neither MPI nor files, and its decisions cannot change a result.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "mpi/job/cost_model.hpp"
#include "mpi/job/messages.hpp"
#include "plan/grid.hpp"
#include "plan/pieces.hpp"

namespace rubatlas::mpi {

class Schedule {
 public:
  /// What the atlas has of earlier runs of the job.
  struct Stored {
    std::span<const std::uint8_t> status;  ///< one per point; only pending points are handed out
    std::span<const std::uint8_t> seam;    ///< one per point; empty where lines are not swept in pieces
    /// The end of a point whose status is done, from which its line goes on.
    std::function<motion::PointStart(std::size_t point)> final_state;
  };
  Schedule(const plan::Grid& grid, const plan::Pieces& pieces, const Stored& stored, int rank_count);

  /// Expected seconds of a point at this place on the axis of the speed ratio, measured before the job.
  void expect(std::size_t speed_index, double seconds) { costs_.assume(speed_index, seconds); }

  /// The next assignment for a rank; empty when there is none now (`has_more` tells whether there may be one
  /// later).
  std::optional<Assignment> next(int rank);

  /// How a point ended.
  struct Ending {
    ending::PointStatus status = ending::PointStatus::pending;
    ending::StatusDetail detail = ending::StatusDetail::none;
  };
  /// A verdict, and the ranks that hold points of the piece.
  struct Decision {
    Verdict verdict;
    std::vector<int> ranks;
  };
  /// What a report brings about.
  struct Outcome {
    std::vector<Ending> finished;  ///< of points whose rows stand from now on
    std::vector<Decision> decisions;
  };
  /// One point of an assignment is computed. The last point of an assignment frees its run.
  Outcome record(const PointReport& report);

  /// Whether points will be handed out, now or later.
  [[nodiscard]] bool has_more() const { return unassigned_ > 0 || undecided_ > 0; }
  /// Expected seconds of all points not yet reported, divided by the recorded seconds; the estimate of the
  /// time left uses it.
  [[nodiscard]] double remaining_over_recorded() const;
  /// Seconds that all reported points took together.
  [[nodiscard]] double recorded() const { return costs_.recorded(); }

 private:
  /// A line, or a piece of it with its lead-in. There may be millions: what only a run under way needs is
  /// in `Course`.
  struct Run {
    std::uint32_t next = 0;  ///< first visit that is not handed out
    std::uint32_t out = 0;   ///< visits handed out and not reported
    bool whole = false;      ///< it goes through all its visits, those whose rows are stored included
    bool decided = false;    ///< its points stand as soon as they are computed
    bool taken = false;      ///< a rank has made it its own
  };
  /// A point that a run has found, and that may be replaced.
  struct Found {
    bool there = false;
    Keep keep = Keep::never;
    Ending ending;
    analysis::MotionTrace trace;
  };
  /// The comparison of a run's first point with the end of the run before, ahead of the front.
  enum class Ahead : std::uint8_t { not_compared, under_way, same, different };
  /// A run under way.
  struct Course {
    std::size_t first_visit = 0;             ///< computed by this job
    std::optional<std::size_t> last_visit;   ///< reported; nothing before the first report
    std::optional<motion::PointStart> last;  ///< its end; nothing if it failed
    std::vector<Found> found;                ///< by place in the piece, while undecided
    std::set<int> holders;                   ///< ranks that compute points while undecided
    double seconds = 0.0;                    ///< of the points reported
    Ahead ahead = Ahead::not_compared;
  };
  /// Where the points of a line that stand end.
  struct Front {
    std::size_t piece = 0;
    std::size_t visit = 0;
    std::optional<motion::PointStart> start;  ///< end of the point before; nothing if it failed
    bool behind_run = false;                  ///< `start` is the end of a run, where nothing was replaced
    bool waits = false;                       ///< its next point is handed out, or about to be
  };

  [[nodiscard]] std::size_t line_of(std::size_t run) const { return run / pieces_.per_line(); }
  [[nodiscard]] std::size_t piece_of(std::size_t run) const { return run % pieces_.per_line(); }
  [[nodiscard]] std::size_t end_of(std::size_t run) const { return pieces_.end(piece_of(run)); }
  [[nodiscard]] std::size_t run_of(std::size_t line, std::size_t piece) const {
    return line * pieces_.per_line() + piece;
  }
  [[nodiscard]] bool is_stored(std::size_t line, std::size_t visit) const {
    return status_[grid_.point(line, visit)] != 0;
  }
  [[nodiscard]] std::optional<motion::PointStart> stored_end(std::size_t line, std::size_t visit) const;
  [[nodiscard]] bool is_complete(std::size_t run) const {
    return runs_[run].next == end_of(run) && runs_[run].out == 0;
  }
  [[nodiscard]] bool has_unassigned(std::size_t run) const { return runs_[run].next < end_of(run); }
  [[nodiscard]] bool is_free(std::size_t run) const {
    return has_unassigned(run) && (runs_[run].out == 0 || !chained_);
  }
  [[nodiscard]] Keep keep_of(std::size_t run, std::size_t visit) const;
  void skip_stored(std::size_t number);
  [[nodiscard]] bool is_decided_in_atlas(std::size_t line, std::size_t piece) const;

  /// Runs in the order in which they are begun: piece after piece, and lines far apart one after the other.
  /// Neighbouring lines cost alike, so that those already computed tell early what the others will cost.
  [[nodiscard]] std::size_t in_order(std::size_t place) const {
    const std::size_t lines = runs_.size() / pieces_.per_line();
    return run_of(line_of(place) * stride_ % lines, piece_of(place));
  }
  std::optional<std::size_t> choose_run(std::size_t& own);
  std::optional<std::size_t> choose_longest();
  void begin_endgame();
  [[nodiscard]] std::size_t assignment_length() const;
  [[nodiscard]] std::optional<motion::PointStart> start_of(std::size_t number) const;
  Assignment assignment_of_run(std::size_t number, int rank);
  Assignment assignment_at_seam(std::size_t run);

  void record_of_run(const PointReport& report, Outcome& outcome);
  void record_at_front(const PointReport& report, Outcome& outcome);
  void compare_ahead(std::size_t number);
  void advance(std::size_t line, Outcome& outcome);
  void start_behind(std::size_t run, Front& front) const;
  void decide(std::size_t number, std::size_t kept_from, Outcome& outcome);

  [[nodiscard]] std::size_t speed_index(std::size_t line, std::size_t visit) const;
  [[nodiscard]] double expected(std::size_t line, std::size_t first_visit, std::size_t last_visit) const;
  /// Expected seconds of a run's points that are not reported.
  [[nodiscard]] double remaining(std::size_t number) const;

  const plan::Grid& grid_;
  plan::Pieces pieces_;
  bool chained_;
  std::vector<std::uint8_t> status_;  ///< of the points when the job began
  std::vector<std::uint8_t> seam_;
  std::function<motion::PointStart(std::size_t point)> final_state_;
  std::vector<Run> runs_;  ///< piece by piece, line by line
  std::map<std::size_t, Course> courses_;
  std::map<std::size_t, Front> fronts_;   ///< by line
  std::deque<std::size_t> ready_;         ///< runs with a point to be compared
  std::vector<std::size_t> run_of_rank_;  ///< the run that it had last
  CostModel costs_;
  std::vector<std::size_t> left_at_speed_;  ///< points of runs that are not reported, by speed
  std::size_t first_open_ = 0;              ///< all runs before are taken or complete, by `in_order`
  std::size_t stride_ = 1;                  ///< from line to line in that order
  std::optional<std::vector<std::size_t>> last_runs_;  ///< all unfinished runs when few are left
  std::size_t unassigned_ = 0;                         ///< points of runs that are not handed out
  std::size_t undecided_ = 0;                          ///< pieces whose seam is not decided
  std::size_t unfinished_runs_ = 0;                    ///< with points that are not reported
};

}  // namespace rubatlas::mpi

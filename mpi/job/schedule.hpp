/// The points that are still to be computed, and the next piece for each rank.
///
/// In a sweep each point starts from the end of the point before it. A line is therefore handed out in
/// pieces, in order, to one rank at a time. The piece contains its start state, so that the next piece may go
/// to another rank. This keeps two ranks busy to the end of seven lines. Preempting a line at the end of a
/// piece costs nothing; therefore the line with the most work left goes first, and pieces become shorter
/// towards the end. With free preemption this rule reaches McNaughton's bound, total work over number of
/// ranks, up to the length of a piece. While there are many lines a seat stays with its line, which keeps the
/// numbers of open lines and of solvers small. Independent points have no order: any rank gets any of them.
///
/// The schedule knows neither MPI nor files, and its decisions cannot change a result.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "mpi/job/cost_model.hpp"
#include "mpi/job/messages.hpp"
#include "plan/grid.hpp"

namespace rubatlas::mpi {

class Schedule {
 public:
  /// `status`: one per point, as the atlas has it; only pending points are handed out. `final_state` returns
  /// the end of a point whose status is done; it is called when the points behind it are handed out. Both
  /// have to outlive the schedule.
  Schedule(const plan::Grid& grid, std::span<const std::uint8_t> status,
           std::function<motion::PointStart(std::size_t point)> final_state, int rank_count);

  /// The next piece for a rank, or for one of its seats where it computes several side by side; empty when
  /// there is none now (`unassigned` tells whether there may be one later).
  std::optional<Piece> next(int rank, int seat = 0);
  /// One point of a piece is computed. The last point of a piece frees its line.
  void record(const PointReport& report);

  /// Largest number of pieces that can be computed at the same time, now or after the present ones have
  /// ended.
  [[nodiscard]] std::size_t side_by_side() const {
    return grid_.points_depend_on_each_other() ? open_lines_ : unreported_;
  }
  /// Number of points that have not been handed out.
  [[nodiscard]] std::size_t unassigned() const { return unassigned_; }
  /// Expected seconds of all points not yet reported, divided by the recorded seconds; the estimate of the
  /// time left uses it.
  [[nodiscard]] double remaining_over_recorded() const;

 private:
  struct Line {
    std::vector<std::uint64_t> pending;  ///< visits, in order
    std::size_t next = 0;                ///< the first of `pending` that is not handed out
    std::size_t reported = 0;            ///< number of `pending` that are computed
    double seconds = 0.0;                ///< seconds that these took

    [[nodiscard]] bool has_unassigned() const { return next < pending.size(); }
    [[nodiscard]] bool is_under_way() const { return reported < next; }
  };

  [[nodiscard]] std::optional<std::size_t> choose_line(std::size_t own) const;
  [[nodiscard]] std::optional<std::size_t> choose_chained_line(std::size_t own) const;
  [[nodiscard]] std::size_t piece_length() const;
  void set_start(Piece& piece, const Line& line) const;
  /// Expected seconds of a line's points that are not reported.
  [[nodiscard]] double remaining(std::size_t number) const;
  /// Expected seconds of these visits on an average line.
  [[nodiscard]] double expected(std::size_t line, std::uint64_t first_visit, std::uint64_t last_visit) const;

  const plan::Grid& grid_;
  std::span<const std::uint8_t> status_;
  std::function<motion::PointStart(std::size_t point)> final_state_;
  std::vector<Line> lines_;  ///< there may be millions
  /// Ends of the last reported points of lines under way; nothing for a line whose last point failed.
  std::map<std::size_t, motion::PointStart> ends_;
  std::map<std::pair<int, int>, std::size_t>
      line_of_seat_;  ///< by rank and seat; the line that the seat had last
  std::size_t rank_count_;
  CostModel costs_;
  std::size_t unassigned_ = 0;
  std::size_t unreported_ = 0;
  std::size_t open_lines_ = 0;  ///< lines with points that are not reported
};

}  // namespace rubatlas::mpi

/// Which points are still to be computed, and who gets which next.
///
/// In a sweep each point starts from the one before it, so a line is handed out in pieces, in order, to one
/// rank at a time; the state goes along with the piece, and the next piece may go to another rank. That is
/// what keeps two ranks busy to the end of seven lines: preempting a line at a piece's end costs nothing, so
/// the line with the most work left goes first (with free preemption this rule reaches McNaughton's bound,
/// total work over ranks, up to the length of a piece), and pieces get shorter towards the end. While there
/// are many lines a seat stays with its line, which keeps the number of lines under way, and of solvers,
/// small. Independent points have no order: any rank gets any of them.
///
/// Knows neither MPI nor files; nothing that it decides can change a result.
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
  /// `status`: one per point, as the atlas has it; only pending points are handed out. `final_state`: of a
  /// point whose status is done, asked for here only, where a line goes on behind it.
  Schedule(const plan::Grid& grid, std::span<const std::uint8_t> status,
           const std::function<point::PointStart(std::size_t point)>& final_state, int rank_count);

  /// The next piece for a rank, or for one of its seats where it computes several side by side; nothing when
  /// there is none for it now (`unassigned` says whether there may be later).
  std::optional<Piece> next(int rank, int seat = 0);
  /// One point of a piece is done. The last one frees the line.
  void record(const PointReport& report);

  /// How many pieces can be under way at the same time, now or when those that are have ended.
  [[nodiscard]] std::size_t side_by_side() const {
    return grid_.points_depend_on_each_other() ? open_lines_ : unreported_;
  }
  /// Points that have not been handed out.
  [[nodiscard]] std::size_t unassigned() const { return unassigned_; }
  /// Expected seconds of all points not yet reported, over the seconds recorded: what ETA needs.
  [[nodiscard]] double remaining_over_recorded() const;

 private:
  struct Line {
    std::vector<std::uint64_t> pending;     ///< visits, in order
    std::size_t next = 0;                   ///< the first of `pending` that is not handed out
    std::size_t reported = 0;               ///< how many of them are computed
    double seconds = 0.0;                   ///< what those took
    std::optional<point::PointStart> last;  ///< end of the last reported point; nothing if it failed
    std::map<std::uint64_t, point::PointStart>
        stored;  ///< starts of visits behind a point that was done before

    [[nodiscard]] bool has_unassigned() const { return next < pending.size(); }
    [[nodiscard]] bool is_under_way() const { return reported < next; }
  };

  [[nodiscard]] std::optional<std::size_t> choose_line(std::size_t own) const;
  [[nodiscard]] std::optional<std::size_t> choose_chained_line(std::size_t own) const;
  [[nodiscard]] std::size_t piece_length() const;
  void set_start(Piece& piece, const Line& line) const;
  /// Expected seconds of a line's points that are not reported.
  [[nodiscard]] double remaining(std::size_t number) const;
  /// Of an average line, over the speeds that these visits of the line meet.
  [[nodiscard]] double expected(std::size_t line, std::uint64_t first_visit, std::uint64_t last_visit) const;

  const plan::Grid& grid_;
  std::vector<Line> lines_;
  std::map<std::pair<int, int>, std::size_t> line_of_seat_;  ///< by rank and seat; the last one it had
  std::size_t rank_count_;
  CostModel costs_;
  std::size_t unassigned_ = 0;
  std::size_t unreported_ = 0;
  std::size_t open_lines_ = 0;  ///< with points that are not reported
};

}  // namespace rubatlas::mpi

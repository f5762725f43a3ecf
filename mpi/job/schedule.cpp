#include "mpi/job/schedule.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace rubatlas::mpi {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
constexpr auto kDone = static_cast<std::uint8_t>(point::PointStatus::done);

/// Long enough that messages are rare beside computing, short enough that the lines progress evenly.
constexpr std::size_t kLongestPiece = 16;
/// Pieces become shorter when the points left are fewer than this many pieces of full length for each seat.
constexpr std::size_t kPiecesPerSeat = 8;
/// A line is urgent when it alone would take this share of the time that all ranks need for the rest of the
/// job. A rank then leaves its own line for it.
constexpr double kUrgentShare = 0.25;

}  // namespace

Schedule::Schedule(const plan::Grid& grid, std::span<const std::uint8_t> status,
                   std::function<motion::PointStart(std::size_t point)> final_state, int rank_count)
    : grid_(grid),
      status_(status),
      final_state_(std::move(final_state)),
      lines_(grid.line_count()),
      rank_count_(static_cast<std::size_t>(rank_count)),
      costs_(grid.speed_count()) {
  for (std::size_t number = 0; number < lines_.size(); ++number) {
    Line& line = lines_[number];
    for (std::size_t visit = 0; visit < grid.speed_count(); ++visit) {
      if (status[grid.point(number, visit)] == 0) line.pending.push_back(visit);
    }
    unassigned_ += line.pending.size();
    if (!line.pending.empty()) ++open_lines_;
  }
  unreported_ = unassigned_;
}

std::optional<Piece> Schedule::next(int rank, int seat) {
  std::size_t& own = line_of_seat_.try_emplace({rank, seat}, kNone).first->second;
  const auto choice = choose_line(own);
  if (!choice) return std::nullopt;
  Line& line = lines_[*choice];
  Piece piece;
  piece.seat = seat;
  piece.line = *choice;
  piece.first_visit = line.pending[line.next];
  set_start(piece, line);
  const std::size_t length = piece_length();
  while (line.has_unassigned() && piece.count < length &&
         line.pending[line.next] == piece.first_visit + piece.count) {
    ++piece.count;
    ++line.next;
    --unassigned_;
  }
  own = *choice;
  return piece;
}

void Schedule::set_start(Piece& piece, const Line& line) const {
  if (!grid_.points_depend_on_each_other() || piece.first_visit == 0) return;
  const bool behind_reported = line.next > 0 && line.pending[line.next - 1] + 1 == piece.first_visit;
  const std::size_t before = grid_.point(piece.line, piece.first_visit - 1);
  const auto end = ends_.find(piece.line);
  const auto start_from = [&](const motion::PointStart& start) {
    piece.start = start.state;
    piece.memory = start.memory;
    piece.from_initial = 0;
  };
  if (behind_reported && end != ends_.end()) {
    start_from(end->second);
  } else if (!behind_reported && status_[before] == kDone) {
    start_from(final_state_(before));
  }
}

void Schedule::record(const PointReport& report) {
  Line& line = lines_[report.line];
  ++line.reported;
  --unreported_;
  if (line.reported == line.pending.size()) --open_lines_;
  line.seconds += report.seconds;
  ends_.erase(report.line);
  if (report.status == point::PointStatus::done && line.reported < line.pending.size()) {
    ends_.emplace(report.line, motion::PointStart(report.final_state, report.final_memory));
  }
  const auto visit = static_cast<std::size_t>(report.visit);
  const bool up = grid_.direction(report.line) == plan::Direction::up;
  costs_.record(up ? visit : grid_.speed_count() - 1 - visit, report.seconds);
}

std::optional<std::size_t> Schedule::choose_line(std::size_t own) const {
  if (unassigned_ == 0) return std::nullopt;
  if (grid_.points_depend_on_each_other()) return choose_chained_line(own);
  if (own != kNone && lines_[own].has_unassigned()) return own;
  const auto open =
      std::find_if(lines_.begin(), lines_.end(), [](const Line& line) { return line.has_unassigned(); });
  return static_cast<std::size_t>(open - lines_.begin());
}

std::optional<std::size_t> Schedule::choose_chained_line(std::size_t own) const {
  double total = 0.0;
  double most = -1.0;
  std::optional<std::size_t> longest;
  const auto is_free = [&](std::size_t number) {
    return lines_[number].has_unassigned() && !lines_[number].is_under_way();
  };
  for (std::size_t number = 0; number < lines_.size(); ++number) {
    const double left = remaining(number);
    total += left;
    if (is_free(number) && left > most) {
      most = left;
      longest = number;
    }
  }
  const bool urgent = most > kUrgentShare * total / static_cast<double>(rank_count_);
  return own != kNone && is_free(own) && !urgent ? own : longest;
}

std::size_t Schedule::piece_length() const {
  const std::size_t seats = std::max(rank_count_, line_of_seat_.size());
  return std::clamp(unassigned_ / (kPiecesPerSeat * seats), std::size_t{1}, kLongestPiece);
}

double Schedule::expected(std::size_t line, std::uint64_t first_visit, std::uint64_t last_visit) const {
  if (grid_.direction(line) == plan::Direction::up) return costs_.expected(first_visit, last_visit);
  return costs_.expected(grid_.speed_count() - last_visit, grid_.speed_count() - first_visit);
}

double Schedule::remaining(std::size_t number) const {
  const Line& line = lines_[number];
  if (line.reported == line.pending.size()) return 0.0;
  const double left = expected(number, line.pending[line.reported], line.pending.back() + 1);
  if (line.reported == 0) return left;
  const double average = expected(number, line.pending.front(), line.pending[line.reported - 1] + 1);
  return average > 0.0 ? left * line.seconds / average : left;
}

double Schedule::remaining_over_recorded() const {
  double left = 0.0;
  for (std::size_t number = 0; number < lines_.size(); ++number) left += remaining(number);
  return costs_.recorded() > 0.0 ? left / costs_.recorded() : 0.0;
}

}  // namespace rubatlas::mpi

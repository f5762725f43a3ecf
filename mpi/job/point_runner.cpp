#include "mpi/job/point_runner.hpp"
#include "assembly/make_line_solver.hpp"

#include <algorithm>
#include <iterator>

namespace rubatlas::mpi {

PointRunner::PointRunner(const settings::Scene& scene, const plan::Grid& grid, atlas::AtlasWriter& writer,
                         const batch::Width& width)
    : scene_(scene),
      grid_(grid),
      writer_(writer),
      width_(width),
      batch_(batch::make_line_batch(width)),
      seats_(static_cast<std::size_t>(width.seats)) {}

/// Where points are independent, several seats may compute points of the same line, each with its own solver.
PointRunner::CachedSolver& PointRunner::solver_of(std::size_t line) {
  const auto known = std::find_if(solvers_.begin(), solvers_.end(), [&](const CachedSolver& cached) {
    return cached.line == line && !cached.seated;
  });
  if (known != solvers_.end()) {
    solvers_.splice(solvers_.begin(), solvers_, known);
    return solvers_.front();
  }
  if (solvers_.size() == kSolversKept) {
    const auto oldest =
        std::find_if(solvers_.rbegin(), solvers_.rend(), [](const auto& cached) { return !cached.seated; });
    solvers_.erase(std::prev(oldest.base()));
  }
  const plan::PointParameters parameters = grid_.parameters(grid_.point(line, 0));
  solvers_.push_front({line, batch::make_line_solver(width_, scene_, parameters, tables_)});
  return solvers_.front();
}

void PointRunner::begin(const Piece& piece) {
  Seat& seat = seats_.at(static_cast<std::size_t>(piece.seat));
  seat.left = piece;
  seat.solver = &solver_of(piece.line);
  seat.solver->seated = true;
  seat.waits = true;
  ++pieces_;
  ++waiting_;
}

void PointRunner::run(const Callbacks& callbacks) {
  const auto go_on = [&] {
    const bool goes_on = callbacks.go_on();
    writer_.settle_if_due();
    begin_points(callbacks);
    return goes_on;
  };
  begin_points(callbacks);
  while (pieces_ > 0) {
    finish_point(batch_->advance(go_on), callbacks);
    begin_points(callbacks);
  }
}

/// When a piece is given up here, the same seat may get another one.
void PointRunner::begin_points(const Callbacks& callbacks) {
  while (waiting_ > 0) {
    for (int number = 0; number < seats(); ++number) {
      Seat& seat = seats_[static_cast<std::size_t>(number)];
      if (!seat.waits) continue;
      seat.waits = false;
      --waiting_;
      if (callbacks.stop()) {
        end_piece(number, callbacks);
      } else {
        begin_point(number);
      }
    }
  }
}

void PointRunner::begin_point(int seat_number) {
  const Seat& seat = seats_[static_cast<std::size_t>(seat_number)];
  const motion::PointStart initial(
      motion::SectionState{scene_.initial.x, scene_.initial.y, scene_.initial.vx, scene_.initial.vy});
  const std::size_t point = grid_.point(seat.left.line, seat.left.first_visit);
  batch_->begin(
      seat_number, *seat.solver->solver, grid_.parameters(point).speed_ratio,
      seat.left.from_initial != 0 ? initial : motion::PointStart(seat.left.start, seat.left.memory));
}

void PointRunner::finish_point(const batch::Finished& finished, const Callbacks& callbacks) {
  Seat& seat = seats_[static_cast<std::size_t>(finished.seat)];
  Piece& left = seat.left;
  const point::PointOutcome& outcome = finished.outcome;
  if (outcome.status == point::PointStatus::pending) {  // given up
    end_piece(finished.seat, callbacks);
    return;
  }
  writer_.write_point(grid_.point(left.line, left.first_visit), left.from_initial != 0, outcome);

  PointReport report;
  report.line = left.line;
  report.visit = left.first_visit;
  report.status = outcome.status;
  report.detail = outcome.detail;
  report.final_state = outcome.final_state;
  report.final_memory = outcome.final_memory;
  report.work = outcome.work;
  report.seconds = finished.seconds;
  callbacks.after_point(report);

  const bool goes_on = grid_.points_depend_on_each_other() && outcome.status == point::PointStatus::done;
  left.from_initial = goes_on ? 0 : 1;
  left.start = outcome.final_state;
  left.memory = outcome.final_memory;
  ++left.first_visit;
  if (--left.count == 0) {
    end_piece(finished.seat, callbacks);
  } else {
    seat.waits = true;
    ++waiting_;
  }
}

void PointRunner::end_piece(int seat_number, const Callbacks& callbacks) {
  Seat& seat = seats_[static_cast<std::size_t>(seat_number)];
  seat.solver->seated = false;
  seat.solver = nullptr;
  --pieces_;
  callbacks.piece_over(seat_number);
}

}  // namespace rubatlas::mpi

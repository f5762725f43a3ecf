#include "mpi/job/point_runner.hpp"
#include "assembly/make_line_solver.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace rubatlas::mpi {
namespace {

/// Computed points wait at most this long for further points of their piece before they are reported.
constexpr std::chrono::seconds kReportPeriod{1};

}  // namespace

PointRunner::PointRunner(const settings::Scene& scene, const plan::Grid& grid, atlas::AtlasWriter& writer,
                         const batch::Width& width)
    : scene_(scene),
      grid_(grid),
      writer_(writer),
      width_(width),
      batch_(batch::make_line_batch(width)),
      seats_(static_cast<std::size_t>(width.seats)) {
  if (plan::Pieces(scene).per_line() > 1) traces_.emplace(scene);
}

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
  const settings::Scene& observed = traces_ ? traces_->observed() : scene_;
  solvers_.push_front({line, batch::make_line_solver(width_, observed, parameters, tables_)});
  return solvers_.front();
}

void PointRunner::begin(const Piece& piece) {
  Seat& seat = seats_.at(static_cast<std::size_t>(piece.seat));
  seat.left = piece;
  seat.solver = &solver_of(piece.line);
  seat.solver->seated = true;
  seat.waits = true;
  seat.reported = std::chrono::steady_clock::now();
  ++pieces_;
  ++waiting_;
}

void PointRunner::run(const Callbacks& callbacks) {
  const auto go_on = [&] { return attend(callbacks); };
  integrating_.start();
  begin_points(callbacks);
  while (pieces_ > 0) {
    finish_point(batch_->advance(go_on), callbacks);
    begin_points(callbacks);
  }
  integrating_.stop();
}

/// Time that is not spent integrating, from its construction to its destruction.
class PointRunner::Interruption {
 public:
  explicit Interruption(ProcessorWatch& integrating)
      : integrating_(integrating), interrupts_(integrating.is_running()) {
    if (interrupts_) integrating_.stop();
  }
  ~Interruption() {
    if (interrupts_) integrating_.start();
  }
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

 private:
  ProcessorWatch& integrating_;
  bool interrupts_;
};

bool PointRunner::attend(const Callbacks& callbacks) {
  if (!goes_on_ || !pace_.is_due()) return goes_on_;
  const Interruption interruption(integrating_);
  goes_on_ = callbacks.go_on();
  settle_if_due();
  begin_points(callbacks);
  return goes_on_;
}

void PointRunner::settle_if_due() {
  if (!writer_.is_due()) return;
  const Interruption interruption(integrating_);
  write(&atlas::AtlasWriter::settle);
}

void PointRunner::write(void (atlas::AtlasWriter::*call)()) {
  const auto began = std::chrono::steady_clock::now();
  (writer_.*call)();
  writing_seconds_ += seconds_since(began);
}

/// When a piece is given up here, the same seat may get another one.
void PointRunner::begin_points(const Callbacks& callbacks) {
  while (waiting_ > 0) {
    for (int number = 0; number < seats(); ++number) {
      Seat& seat = seats_[static_cast<std::size_t>(number)];
      if (!seat.waits) continue;
      seat.waits = false;
      --waiting_;
      if (goes_on_) {
        begin_point(number);
      } else {
        end_piece(number, callbacks);
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

/// Gives a row to the writer, holds it or lets it go, as the piece says; the report tells which.
void PointRunner::keep_row(const Piece& piece, point::PointOutcome& outcome, PointReport& computed) {
  if (piece.keep == Keep::never) return;
  atlas::Origin origin{.restarted = piece.from_initial != 0};
  if (piece.keep == Keep::after_verdict) computed.trace = traces_->trace(outcome);
  if (piece.keep == Keep::where_it_differs || piece.keep == Keep::compared) {
    computed.same_motion = traces_->is_same_motion(outcome, piece.found) ? 1 : 0;
    if (computed.same_motion != 0 || piece.keep == Keep::compared) return;
    origin.seam = plan::Seam::repaired;
  }
  if (traces_) traces_->strip(outcome);
  if (piece.keep == Keep::after_verdict) {
    const std::uint8_t motion = computed.trace.motion;
    const bool aperiodic = motion != analysis::motion_class::kNone && !analysis::is_periodic(motion);
    held_.push_back({piece.line, piece.first_visit, origin.restarted, std::move(outcome),
                     aperiodic ? plan::Seam::aperiodic : plan::Seam::agrees});
  } else {
    writer_.add_point(grid_.point(piece.line, piece.first_visit), origin, outcome);
  }
}

void PointRunner::take(const Verdict& verdict) {
  const Interruption interruption(integrating_);
  const auto concerns = [&](std::uint64_t line, std::uint64_t visit) {
    return line == verdict.line && visit >= verdict.begin && visit < verdict.end;
  };
  for (const HeldPoint& point : held_) {
    if (!concerns(point.line, point.visit) || point.visit < verdict.kept_from) continue;
    writer_.add_point(grid_.point(point.line, point.visit),
                      {point.restarted, point.visit == verdict.kept_from ? point.seam : plan::Seam::none},
                      point.outcome);
    if (writer_.is_full()) write(&atlas::AtlasWriter::write_rows);
  }
  write(&atlas::AtlasWriter::write_rows);
  std::erase_if(held_, [&](const HeldPoint& point) { return concerns(point.line, point.visit); });
  for (Seat& seat : seats_) {
    if (seat.solver == nullptr || seat.left.keep != Keep::after_verdict) continue;
    if (concerns(seat.left.line, seat.left.first_visit)) seat.left.keep = Keep::at_once;
  }
}

void PointRunner::finish_point(batch::Finished finished, const Callbacks& callbacks) {
  Seat& seat = seats_[static_cast<std::size_t>(finished.seat)];
  Piece& left = seat.left;
  point::PointOutcome& outcome = finished.outcome;
  if (outcome.status == point::PointStatus::pending) {  // given up
    end_piece(finished.seat, callbacks);
    return;
  }
  PointReport computed{.line = left.line,
                       .run = left.run,
                       .visit = left.first_visit,
                       .status = outcome.status,
                       .detail = outcome.detail,
                       .keep = left.keep,
                       .trace = {},
                       .final_state = outcome.final_state,
                       .seconds = finished.seconds,
                       .final_memory = outcome.final_memory};
  seat.report.work += outcome.work;
  keep_row(left, outcome, computed);
  seat.report.add(computed);
  settle_if_due();

  const bool goes_on = grid_.points_depend_on_each_other() && computed.status == point::PointStatus::done;
  left.from_initial = goes_on ? 0 : 1;
  left.start = computed.final_state;
  left.memory = computed.final_memory;
  ++left.first_visit;
  if (--left.count == 0) {
    end_piece(finished.seat, callbacks);
    return;
  }
  const bool is_due = std::chrono::steady_clock::now() - seat.reported >= kReportPeriod;
  const bool is_awaited = computed.keep != Keep::at_once;
  if (is_due || is_awaited || writer_.is_full()) report(seat, callbacks);
  seat.waits = true;
  ++waiting_;
}

/// Writes the rows of the reported points first, and with them those of other seats.
void PointRunner::report(Seat& seat, const Callbacks& callbacks) {
  const Interruption interruption(integrating_);
  write(&atlas::AtlasWriter::write_rows);
  seat.report.times = {.busy = integrating_.seconds(),
                       .writing = writing_seconds_,
                       .processor = integrating_.reading() - processor_at_start_};
  callbacks.after_points(seat.report);
  seat.report = {};
  seat.reported = std::chrono::steady_clock::now();
}

void PointRunner::end_piece(int seat_number, const Callbacks& callbacks) {
  const Interruption interruption(integrating_);
  Seat& seat = seats_[static_cast<std::size_t>(seat_number)];
  if (seat.report.count > 0) report(seat, callbacks);
  seat.solver->seated = false;
  seat.solver = nullptr;
  --pieces_;
  callbacks.piece_over(seat_number);
}

}  // namespace rubatlas::mpi

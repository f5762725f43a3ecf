#include "mpi/job/point_runner.hpp"

#include <algorithm>
#include <utility>

#include "assembly/make_line_solver.hpp"
#include "plan/scene_of_line.hpp"

namespace rubatlas::mpi {
namespace {

/// Computed points wait at most this long for further points of their assignment before they are reported.
constexpr std::chrono::seconds kReportPeriod{1};

}  // namespace

PointRunner::PointRunner(const settings::Scene& scene, const plan::Grid& grid, atlas::AtlasWriter& writer)
    : scene_(plan::with_short_axes(scene)), grid_(grid), writer_(writer) {
  if (plan::Pieces(scene).per_line() > 1) traces_.emplace(scene_);
}

point::LineSolver& PointRunner::solver_of(std::size_t line) {
  const auto known = std::ranges::find(solvers_, line, &CachedSolver::line);
  if (known != solvers_.end()) {
    solvers_.splice(solvers_.begin(), solvers_, known);
    return *solvers_.front().solver;
  }
  if (solvers_.size() == kSolversKept) solvers_.pop_back();
  const plan::PointParameters parameters = grid_.parameters(grid_.point(line, 0));
  const settings::Scene& observed = traces_ ? traces_->observed() : scene_;
  solvers_.push_front({line, assembly::make_line_solver(observed, parameters, tables_)});
  return *solvers_.front().solver;
}

void PointRunner::run(const Callbacks& callbacks) {
  const modes::GoOn go_on = [&] { return attend(callbacks); };
  const motion::PointStart initial =
      assembly::initial_state(scene_, grid_.parameters(grid_.point(left_.line, 0)));
  reported_ = std::chrono::steady_clock::now();
  point::LineSolver& solver = solver_of(left_.line);
  integrating_.start();
  while (goes_on_ && has_assignment()) {
    const std::size_t point = grid_.point(left_.line, left_.first_visit);
    const auto began = std::chrono::steady_clock::now();
    point::PointOutcome outcome =
        solver.run(grid_.parameters(point).speed_ratio,
                   left_.from_initial != 0 ? initial : motion::PointStart(left_.start, left_.memory), go_on);
    if (outcome.status == ending::PointStatus::pending) break;  // given up
    finish_point(std::move(outcome), seconds_since(began), callbacks);
  }
  left_.count = 0;
  if (report_.count > 0) report(callbacks);
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
  commit_if_due();
  return goes_on_;
}

void PointRunner::commit_if_due() {
  if (!writer_.is_due()) return;
  const Interruption interruption(integrating_);
  write(&atlas::AtlasWriter::commit);
}

void PointRunner::write(void (atlas::AtlasWriter::*call)()) {
  const auto began = std::chrono::steady_clock::now();
  (writer_.*call)();
  writing_seconds_ += seconds_since(began);
}

/// Gives a row to the writer, holds it or lets it go, as the assignment says; the report tells which.
void PointRunner::keep_row(point::PointOutcome& outcome, PointReport& computed) {
  if (left_.keep == Keep::never) return;
  atlas::Origin origin{.restarted = left_.from_initial != 0};
  if (left_.keep == Keep::after_verdict) computed.trace = traces_->trace(outcome);
  if (left_.keep == Keep::where_it_differs || left_.keep == Keep::compared) {
    computed.same_motion = traces_->is_same_motion(outcome, left_.found) ? 1 : 0;
    if (computed.same_motion != 0 || left_.keep == Keep::compared) return;
    origin.seam = plan::Seam::repaired;
  }
  if (traces_) traces_->strip(outcome);
  if (left_.keep == Keep::after_verdict) {
    const std::uint8_t motion = computed.trace.motion;
    const bool aperiodic = motion != analysis::motion_class::kNone && !analysis::is_periodic(motion);
    held_.push_back({left_.line, left_.first_visit, origin.restarted, std::move(outcome),
                     aperiodic ? plan::Seam::aperiodic : plan::Seam::agrees});
  } else {
    writer_.add_point(grid_.point(left_.line, left_.first_visit), origin, outcome);
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
  if (has_assignment() && left_.keep == Keep::after_verdict && concerns(left_.line, left_.first_visit))
    left_.keep = Keep::at_once;
}

void PointRunner::finish_point(point::PointOutcome outcome, double seconds, const Callbacks& callbacks) {
  PointReport computed{.line = left_.line,
                       .run = left_.run,
                       .visit = left_.first_visit,
                       .status = outcome.status,
                       .detail = outcome.detail,
                       .keep = left_.keep,
                       .trace = {},
                       .final_state = outcome.final_state,
                       .seconds = seconds,
                       .final_memory = outcome.final_memory};
  report_.work += outcome.work;
  keep_row(outcome, computed);
  report_.add(computed);
  commit_if_due();

  const bool goes_on = grid_.points_depend_on_each_other() && computed.status == ending::PointStatus::done;
  left_.from_initial = goes_on ? 0 : 1;
  left_.start = computed.final_state;
  left_.memory = computed.final_memory;
  ++left_.first_visit;
  --left_.count;
  const bool is_due = std::chrono::steady_clock::now() - reported_ >= kReportPeriod;
  const bool is_awaited = computed.keep != Keep::at_once;
  if (is_due || is_awaited || writer_.is_full()) report(callbacks);
}

/// Writes the rows of the reported points first.
void PointRunner::report(const Callbacks& callbacks) {
  const Interruption interruption(integrating_);
  write(&atlas::AtlasWriter::write_rows);
  report_.times = {.busy = integrating_.seconds(),
                   .writing = writing_seconds_,
                   .processor = integrating_.reading() - processor_at_start_};
  callbacks.after_points(report_);
  report_ = {};
  reported_ = std::chrono::steady_clock::now();
}

}  // namespace rubatlas::mpi

#include "mpi/point_runner.hpp"

#include <algorithm>
#include <chrono>

namespace rubatlas::mpi {
namespace {

/// Solvers kept per rank. A rank changes lines when a job comes to its end; the lines then under way are few.
constexpr std::size_t kSolversKept = 16;

}  // namespace

PointRunner::PointRunner(const scene::Scene& scene, const plan::Grid& grid, atlas::AtlasWriter& writer)
    : scene_(scene), grid_(grid), writer_(writer) {}

solve::LineSolver& PointRunner::solver_of(std::size_t line) {
  const auto known = std::find_if(solvers_.begin(), solvers_.end(),
                                  [&](const CachedSolver& cached) { return cached.line == line; });
  if (known != solvers_.end()) {
    solvers_.splice(solvers_.begin(), solvers_, known);
  } else {
    if (solvers_.size() == kSolversKept) solvers_.pop_back();
    const plan::PointParameters parameters = grid_.parameters(grid_.point(line, 0));
    solvers_.push_front({line, solve::make_line_solver(scene_, parameters, tables_)});
  }
  return *solvers_.front().solver;
}

void PointRunner::run(const Piece& piece, const Callbacks& callbacks) {
  const solve::PointStart initial(
      solve::SectionState{scene_.initial.x, scene_.initial.y, scene_.initial.vx, scene_.initial.vy});
  solve::LineSolver& solver = solver_of(piece.line);
  bool from_initial = piece.from_initial != 0;
  solve::PointStart start(piece.start, piece.memory);
  for (std::uint64_t visit = piece.first_visit; visit < piece.first_visit + piece.count; ++visit) {
    if (callbacks.stop()) return;
    const auto began = std::chrono::steady_clock::now();
    const std::size_t point = grid_.point(piece.line, visit);
    const solve::PointOutcome outcome = solver.run(
        grid_.parameters(point).speed_ratio, from_initial ? initial : start, callbacks.between_revolutions);
    writer_.write_point(point, from_initial, outcome);

    PointReport report;
    report.line = piece.line;
    report.visit = visit;
    report.status = outcome.status;
    report.final_state = outcome.final_state;
    report.final_memory = outcome.final_memory;
    report.work = outcome.work;
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    callbacks.after_point(report);

    from_initial = !grid_.points_depend_on_each_other() || outcome.status != solve::PointStatus::done;
    start = {outcome.final_state, outcome.final_memory};
  }
}

}  // namespace rubatlas::mpi
